/** Motion of the arm: its forward kinematics, `T_world_tip(q) = mount · Π originᵢ · Rot_z(qᵢ) · flange · tip`, and the planned motion, a cubic per joint between two knots (Hermite), as in platewash. */
import { Matrix4, Quaternion, Vector3 } from "three";
import { floats, indexBefore, NumbersError } from "./numbers.ts";
import type { Arm, Motion as Knots, Pose, Tool } from "./view.ts";

const ONE = new Vector3(1, 1, 1);

/** `T_a_b` of a pose. Its quaternion is normalised first; one without length counts as no turn. */
export function matrixOf({ position_m, quaternion_wxyz: [w, x, y, z] }: Pose): Matrix4 {
  return new Matrix4().compose(new Vector3(...position_m), new Quaternion(x, y, z, w).normalize(), ONE);
}

/** Where an arm's tip is for given joints: the flange where there is no tool. */
export class Kinematics {
  readonly #mount: Matrix4;
  readonly #origins: Matrix4[];
  /** `T_6_tip`. */
  readonly #tip: Matrix4;
  readonly #turn = new Matrix4();
  readonly #frame = new Matrix4();

  constructor(arm: Arm, tool: Tool | null) {
    this.#mount = matrixOf(arm.mount);
    this.#origins = arm.joints.map((joint) => matrixOf(joint.origin));
    this.#tip = matrixOf(arm.flange);
    if (tool !== null) this.#tip.multiply(matrixOf(tool.tip));
  }

  /** `T_world_tip(q)`, q in rad from `offset` on. No allocation. */
  tip(q: ArrayLike<number>, into: Matrix4, offset = 0): Matrix4 {
    this.frames(q, offset, null);
    return into.multiplyMatrices(this.#frame, this.#tip);
  }

  /** `T_world_i(q)` of every joint's frame, the first one first; `visit` must not keep the matrix. */
  frames(q: ArrayLike<number>, offset: number, visit: ((frame: Matrix4) => void) | null): void {
    this.#frame.copy(this.#mount);
    for (let i = 0; i < this.#origins.length; i++) {
      this.#frame.multiply(this.#origins[i]!).multiply(this.#turn.makeRotationZ(q[offset + i]!));
      visit?.(this.#frame);
    }
  }

  /** The tip's places [m] for rows of joints: three numbers a row. */
  places(rows: ArrayLike<number>): Float64Array {
    const axes = Math.max(1, this.#origins.length);
    const count = Math.floor(rows.length / axes);
    const places = new Float64Array(3 * count);
    const [pose, place] = [new Matrix4(), new Vector3()];
    for (let i = 0; i < count; i++) place.setFromMatrixPosition(this.tip(rows, pose, i * axes)).toArray(places, 3 * i);
    return places;
  }
}

/** Joints of an arm. */
export const AXES = 6;

/** Joints at a time: positions [rad], speeds [rad/s], accelerations [rad/s²]. */
export interface JointState {
  q: Float64Array;
  qd: Float64Array;
  qdd: Float64Array;
}

export function newState(): JointState {
  return { q: new Float64Array(AXES), qd: new Float64Array(AXES), qdd: new Float64Array(AXES) };
}

/** Where the joints are at every time. */
export class Motion {
  /** Times of the knots [s]. */
  readonly times: Float64Array;
  readonly #q: Float64Array;
  readonly #qd: Float64Array;
  #hint = 0;

  constructor(times: Float64Array, q: Float64Array, qd: Float64Array) {
    const knots = times.length;
    if (knots === 0) throw new NumbersError("motion without knots");
    if (q.length !== knots * AXES || qd.length !== knots * AXES) {
      throw new NumbersError(`motion of ${knots} knots: ${q.length} positions and ${qd.length} speeds instead of ${knots * AXES}`);
    }
    this.times = times;
    this.#q = q;
    this.#qd = qd;
  }

  static of(knots: Knots): Motion {
    return new Motion(floats(knots.t_s), floats(knots.q_rad), floats(knots.qd_rad_s));
  }

  /** Time of the last knot [s]. */
  get duration(): number {
    return this.times[this.times.length - 1]!;
  }

  /**
   * The joints at `t` [s], accelerations to the right of it. Before the first knot and after the last one the arm rests there.
   * No allocation.
   */
  at(t: number, into: JointState): JointState {
    const last = this.times.length - 1;
    if (last === 0) return this.#rest(0, into);
    this.#hint = Math.min(indexBefore(this.times, this.times.length, t, this.#hint), last - 1);
    this.#piece(this.#hint, Math.max(0, Math.min(t - this.times[this.#hint]!, this.#length(this.#hint))), into);
    if (t < 0 || t > this.duration) {
      into.qd.fill(0);
      into.qdd.fill(0);
    }
    return into;
  }

  /** The joints at the end of the piece before knot `k`, accelerations to the left of it. */
  before(k: number, into: JointState): JointState {
    if (k <= 0) return this.at(this.times[0]!, into);
    this.#piece(k - 1, this.#length(k - 1), into);
    return into;
  }

  #length(k: number): number {
    return this.times[k + 1]! - this.times[k]!;
  }

  #rest(k: number, into: JointState): JointState {
    for (let j = 0; j < AXES; j++) into.q[j] = this.#q[k * AXES + j]!;
    into.qd.fill(0);
    into.qdd.fill(0);
    return into;
  }

  /** `q(u) = c₀ + c₁u + c₂u² + c₃u³` of the piece behind knot `k`. */
  #piece(k: number, u: number, into: JointState): void {
    const h = this.#length(k);
    for (let j = 0; j < AXES; j++) {
      const at = k * AXES + j;
      const q0 = this.#q[at]!;
      const v0 = this.#qd[at]!;
      const v1 = this.#qd[at + AXES]!;
      const slope = (this.#q[at + AXES]! - q0) / h;
      const c2 = (slope * 3 - v0 * 2 - v1) / h;
      const c3 = (v0 + v1 - slope * 2) / (h * h);
      into.q[j] = q0 + (v0 + (c2 + c3 * u) * u) * u;
      into.qd[j] = v0 + (c2 * 2 + c3 * (3 * u)) * u;
      into.qdd[j] = c2 * 2 + c3 * (6 * u);
    }
  }
}

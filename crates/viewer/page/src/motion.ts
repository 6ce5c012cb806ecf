/** The planned motion: between two knots each joint is the cubic of their positions and speeds (Hermite), as in platewash. */
import { floats, indexBefore, NumbersError } from "./numbers.ts";
import type { Motion as Knots } from "./view.ts";

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

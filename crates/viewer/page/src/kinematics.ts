/** Forward kinematics of the document's arm: `T_world_tip(q) = mount · Π originᵢ · Rot_z(qᵢ) · flange · tip`. */
import { Matrix4, Quaternion, Vector3 } from "three";
import type { Arm, Pose, Tool } from "./view.ts";

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

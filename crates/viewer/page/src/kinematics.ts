/** Forward kinematics of the document's arm: `T_world_tip(q) = mount · Π originᵢ · Rot_z(qᵢ) · flange · tip`. */
import type { Arm, Pose, Tool } from "./view.ts";

/** A pose as 4 × 4 matrix, column by column. */
export type Matrix = Float64Array;

/** `T_a_b` of a pose. Its quaternion is normalised first; one without length counts as no turn. */
export function matrixOf(pose: Pose, into: Matrix = new Float64Array(16)): Matrix {
  const [w0, x0, y0, z0] = pose.quaternion_wxyz;
  const length = Math.hypot(w0, x0, y0, z0);
  const [w, x, y, z] = length > 0 ? [w0 / length, x0 / length, y0 / length, z0 / length] : [1, 0, 0, 0];
  into.set([1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y), 0]);
  into.set([2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x), 0], 4);
  into.set([2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y), 0], 8);
  into.set([...pose.position_m, 1], 12);
  return into;
}

/** `a · b` of two poses; `into` may be neither of them. No allocation. */
export function multiply(a: Matrix, b: Matrix, into: Matrix): Matrix {
  for (let column = 0; column < 16; column += 4) {
    for (let row = 0; row < 4; row++) {
      let sum = 0;
      for (let k = 0; k < 4; k++) sum += a[4 * k + row]! * b[column + k]!;
      into[column + row] = sum;
    }
  }
  return into;
}

/** `m · Rot_z(angle)`, in place. No allocation. */
export function turnAboutZ(m: Matrix, angle: number): Matrix {
  const c = Math.cos(angle);
  const s = Math.sin(angle);
  for (let row = 0; row < 3; row++) {
    const x = m[row]!;
    const y = m[4 + row]!;
    m[row] = c * x + s * y;
    m[4 + row] = c * y - s * x;
  }
  return m;
}

/** Where an arm's tip is for given joints: the flange where there is no tool. */
export class Kinematics {
  readonly #mount: Matrix;
  readonly #origins: Matrix[];
  /** `T_6_tip`. */
  readonly #tip: Matrix;
  readonly #a: Matrix = new Float64Array(16);
  readonly #b: Matrix = new Float64Array(16);

  constructor(arm: Arm, tool: Tool | null) {
    this.#mount = matrixOf(arm.mount);
    this.#origins = arm.joints.map((joint) => matrixOf(joint.origin));
    const flange = matrixOf(arm.flange);
    this.#tip = tool === null ? flange : multiply(flange, matrixOf(tool.tip), new Float64Array(16));
  }

  /** `T_world_tip(q)`, q in rad from `offset` on. No allocation. */
  tip(q: ArrayLike<number>, into: Matrix, offset = 0): Matrix {
    return multiply(this.#last(q, offset, null), this.#tip, into);
  }

  /** `T_world_i(q)` of every joint's frame, the first one first; `visit` must not keep the matrix. */
  frames(q: ArrayLike<number>, offset: number, visit: (frame: Matrix) => void): void {
    this.#last(q, offset, visit);
  }

  #last(q: ArrayLike<number>, offset: number, visit: ((frame: Matrix) => void) | null): Matrix {
    let from = this.#a;
    let to = this.#b;
    from.set(this.#mount);
    for (let i = 0; i < this.#origins.length; i++) {
      turnAboutZ(multiply(from, this.#origins[i]!, to), q[offset + i]!);
      visit?.(to);
      const next = to;
      to = from;
      from = next;
    }
    return from;
  }

  /** The tip's places [m] for rows of joints: three numbers a row. */
  places(rows: ArrayLike<number>): Float64Array {
    const axes = Math.max(1, this.#origins.length);
    const count = Math.floor(rows.length / axes);
    const places = new Float64Array(3 * count);
    const pose = new Float64Array(16);
    for (let i = 0; i < count; i++) places.set(this.tip(rows, pose, i * axes).subarray(12, 15), 3 * i);
    return places;
  }
}

/** The smallest clearance over time, as the document has it. */
import { decode, floats, indexBefore } from "./numbers.ts";
import type { Clearance } from "./view.ts";

export type Point = [number, number, number];

/** The smallest clearance at one time. */
export interface ClearanceNow {
  distance_m: number;
  margin_m: number;
  /** The nearest points of the two bodies, world frame. */
  from: Point;
  to: Point;
}

export class Clearances {
  readonly margin: number;
  readonly times: Float64Array;
  readonly distances: Float64Array;
  readonly #points: Float64Array;
  readonly #pair: ArrayLike<number>;
  readonly #names: readonly string[];
  readonly #now: ClearanceNow;
  #hint = 0;

  constructor(clearance: Clearance) {
    this.margin = clearance.margin_m;
    this.times = floats(clearance.t_s);
    this.distances = floats(clearance.distance_m);
    this.#points = floats(clearance.nearest_m);
    this.#pair = decode(clearance.pair);
    this.#names = clearance.names;
    this.#now = { distance_m: Number.NaN, margin_m: this.margin, from: [0, 0, 0], to: [0, 0, 0] };
  }

  /** The sample nearest to `t`; null without any. The object is used again by the next call. */
  at(t: number): ClearanceNow | null {
    if (this.times.length === 0) return null;
    const k = this.#nearest(t);
    const now = this.#now;
    now.distance_m = this.distances[k]!;
    for (let i = 0; i < 3; i++) {
      now.from[i] = this.#points[6 * k + i]!;
      now.to[i] = this.#points[6 * k + 3 + i]!;
    }
    return now;
  }

  /** The two bodies of the sample nearest to `t`. */
  pairAt(t: number): string {
    if (this.times.length === 0) return "";
    const k = this.#nearest(t);
    const name = (side: 0 | 1): string => this.#names[this.#pair[2 * k + side] ?? -1] ?? "?";
    return `${name(0)} – ${name(1)}`;
  }

  #nearest(t: number): number {
    const count = this.times.length;
    const k = indexBefore(this.times, count, t, this.#hint);
    this.#hint = k;
    return k + 1 < count && this.times[k + 1]! - t < t - this.times[k]! ? k + 1 : k;
  }
}

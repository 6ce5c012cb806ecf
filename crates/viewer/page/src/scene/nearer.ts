/** Which places of a disc are nearer to a contact point that cannot be reached than to one that can. */

/** Cells along either edge. */
export const CELLS = 96;

/** Points in square buckets, so that the nearest is found without looking at all. */
class Buckets {
  readonly #side: number;
  readonly #half: number;
  readonly #starts: Uint32Array;
  readonly #xy: Float64Array;

  constructor(points: readonly (readonly [number, number])[], half: number) {
    const count = points.length;
    this.#half = half;
    this.#side = Math.max(1, Math.min(CELLS, Math.ceil(Math.sqrt(count))));
    const buckets = points.map(([x, y]) => this.#cell(y) * this.#side + this.#cell(x));
    this.#starts = new Uint32Array(this.#side * this.#side + 1);
    for (const bucket of buckets) this.#starts[bucket + 1]!++;
    for (let k = 1; k < this.#starts.length; k++) this.#starts[k]! += this.#starts[k - 1]!;
    this.#xy = new Float64Array(2 * count);
    const at = this.#starts.slice();
    buckets.forEach((bucket, i) => this.#xy.set(points[i]!, 2 * at[bucket]!++));
  }

  /** Row or column of a coordinate; what lies outside counts to the border. */
  #cell(x: number): number {
    return Math.max(0, Math.min(this.#side - 1, Math.floor(((x / this.#half + 1) / 2) * this.#side)));
  }

  /** Squared distance to the nearest point, `most` where none is nearer. */
  nearest(x: number, y: number, most: number): number {
    const [column, row] = [this.#cell(x), this.#cell(y)];
    const edge = (2 * this.#half) / this.#side;
    let best = most;
    for (let ring = 0; ring < this.#side; ring++) {
      const gap = (ring - 1) * edge;
      if (gap > 0 && gap * gap > best) break;
      for (let r = Math.max(0, row - ring); r <= Math.min(this.#side - 1, row + ring); r++) {
        const step = Math.abs(r - row) === ring || ring === 0 ? 1 : 2 * ring;
        for (let c = column - ring; c <= column + ring; c += step) {
          if (c >= 0 && c < this.#side) best = this.#least(r * this.#side + c, x, y, best);
        }
      }
    }
    return best;
  }

  #least(bucket: number, x: number, y: number, most: number): number {
    let best = most;
    for (let k = this.#starts[bucket]!; k < this.#starts[bucket + 1]!; k++) {
      const [dx, dy] = [this.#xy[2 * k]! - x, this.#xy[2 * k + 1]! - y];
      best = Math.min(best, dx * dx + dy * dy);
    }
    return best;
  }
}

/**
 * The square of half edge `half_m` about a plate's axis, row by row from the least y, x ascending: 255 where a place is nearer to a dead
 * point than to any free one, else 0. Points are in the plate's frame; those that are not finite, or off the square, do not count.
 */
export function deadNearer(free: readonly (readonly number[])[], dead: readonly (readonly number[])[], half_m: number): Uint8Array {
  const raster = new Uint8Array(CELLS * CELLS);
  const within = (points: readonly (readonly number[])[]): [number, number][] =>
    points.map(([x = Number.NaN, y = Number.NaN]): [number, number] => [x, y]).filter((point) => point.every((v) => Math.abs(v) <= 1.5 * half_m));
  const lost = within(dead);
  if (!(half_m > 0) || lost.length === 0) return raster;
  const [deadOnes, freeOnes] = [new Buckets(lost, half_m), new Buckets(within(free), half_m)];
  const middleOf = (k: number): number => ((2 * k + 1) / CELLS - 1) * half_m;
  for (let row = 0; row < CELLS; row++) {
    for (let column = 0; column < CELLS; column++) {
      const [x, y] = [middleOf(column), middleOf(row)];
      const limit = freeOnes.nearest(x, y, Infinity);
      if (deadOnes.nearest(x, y, limit) < limit) raster[row * CELLS + column] = 255;
    }
  }
  return raster;
}

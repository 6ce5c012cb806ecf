/** Lines of a width in pixels of the page, whatever the resolution of the screen. */
import { InterleavedBufferAttribute, LessEqualDepth, Line3, Vector3, type DepthModes } from "three";
import { LineMaterial } from "three/examples/jsm/lines/LineMaterial.js";
import { LineSegments2 } from "three/examples/jsm/lines/LineSegments2.js";
import { LineSegmentsGeometry } from "three/examples/jsm/lines/LineSegmentsGeometry.js";

export interface LineStyle {
  /** In CSS pixels. */
  width: number;
  opacity?: number;
  /** Lengths of dash and gap [m]. */
  dash_m?: [number, number];
  depth?: DepthModes;
  /** Which of coincident lines is in front: the greater one; 1 without it. */
  before?: number;
}

/** Places, three coordinates each; consecutive ones are joined. */
export type Polyline = ArrayLike<number>;

/** Ends of the stretches of polylines, six coordinates each; without those that are not finite. */
export function stretches(polylines: readonly Polyline[]): Float32Array {
  const all = new Float32Array(6 * polylines.reduce((sum, line) => sum + Math.max(0, Math.floor(line.length / 3) - 1), 0));
  let at = 0;
  for (const line of polylines) {
    for (let i = 0; i + 5 < line.length; i += 3) {
      for (let k = 0; k < 6; k++) all[at + k] = line[i + k]!;
      if (all.subarray(at, at + 6).every(Number.isFinite)) at += 6;
    }
  }
  return all.subarray(0, at);
}

/** A polyline with fewer places, none of those left out farther off than `tolerance_m` (Douglas and Peucker). */
export function simplified(line: Polyline, tolerance_m: number): Float64Array {
  const count = Math.floor(line.length / 3);
  const places = Array.from({ length: count }, (_, k) => new Vector3(line[3 * k], line[3 * k + 1], line[3 * k + 2]));
  const [span, nearest] = [new Line3(), new Vector3()];
  const keep = new Uint8Array(count);
  const open: [number, number][] = count > 0 ? [[0, count - 1]] : [];
  for (let next = open.pop(); next !== undefined; next = open.pop()) {
    const [from, to] = next;
    keep[from] = keep[to] = 1;
    let [farthest, away] = [-1, tolerance_m * tolerance_m];
    span.set(places[from]!, places[to]!);
    for (let at = from + 1; at < to; at++) {
      const distance = span.closestPointToPoint(places[at]!, true, nearest).distanceToSquared(places[at]!);
      if (distance > away) [farthest, away] = [at, distance];
    }
    if (farthest >= 0) open.push([from, farthest], [farthest, to]);
  }
  return Float64Array.from(places.filter((_, at) => keep[at] === 1).flatMap((place) => place.toArray()));
}

/** Stretches of line in one call of the graphics processor; there must be one at least. */
export class Lines extends LineSegments2 {
  readonly style: LineMaterial;
  readonly #dashed: boolean;
  readonly #opacity: number;
  #count: number;

  constructor(ends: Float32Array, style: LineStyle) {
    const dashed = style.dash_m !== undefined;
    const opacity = style.opacity ?? 1;
    const material = new LineMaterial({
      linewidth: style.width,
      worldUnits: false,
      toneMapped: false,
      transparent: opacity < 1,
      opacity,
      dashed,
      dashSize: style.dash_m?.[0] ?? 1,
      gapSize: style.dash_m?.[1] ?? 0,
      depthFunc: style.depth ?? LessEqualDepth,
      depthWrite: opacity >= 1,
      polygonOffset: true,
      polygonOffsetFactor: -(style.before ?? 1),
      polygonOffsetUnits: -8 * (style.before ?? 1),
    });
    super(new LineSegmentsGeometry(), material);
    this.style = material;
    this.#dashed = dashed;
    this.#opacity = opacity;
    this.#count = 0;
    this.setEnds(ends);
  }

  /** Draws other stretches. */
  setEnds(ends: Float32Array): void {
    this.geometry.dispose();
    this.geometry = new LineSegmentsGeometry();
    this.geometry.setPositions(ends.length > 0 ? ends : new Float32Array(6));
    this.#count = ends.length / 6;
    this.visible = ends.length > 0;
    if (this.#dashed) this.computeLineDistances();
  }

  /** Draws the lines as faint as this share of how they were made, which changes their program at 1. */
  setFaint(share: number): void {
    const opacity = share * this.#opacity;
    if (opacity === this.style.opacity) return;
    this.style.opacity = opacity;
    if (this.style.transparent === opacity < 1) return;
    this.style.transparent = opacity < 1;
    this.style.depthWrite = opacity >= 1;
    this.style.needsUpdate = true;
  }

  /** Whether there is anything to draw. */
  get any(): boolean {
    return this.#count > 0;
  }

  /** Width [CSS px]. */
  setWidth(width: number): void {
    this.style.linewidth = width;
  }

  setColour(colour: string): void {
    this.style.color.set(colour);
  }

  /** Draws only the first `count` stretches. */
  setCount(count: number): void {
    this.geometry.instanceCount = Math.max(0, Math.min(this.#count, count));
  }

  /** Moves the ends of the first stretch. No allocation. */
  moveFirst(from: readonly number[], to: readonly number[]): void {
    const ends = this.geometry.getAttribute("instanceStart");
    if (!(ends instanceof InterleavedBufferAttribute)) return;
    for (let k = 0; k < 3; k++) {
      ends.data.array[k] = from[k] ?? 0;
      ends.data.array[3 + k] = to[k] ?? 0;
    }
    ends.data.needsUpdate = true;
  }
}

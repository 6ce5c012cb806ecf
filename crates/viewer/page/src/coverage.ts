/** A plate's coverage over time: sampled on a raster to look at, not the proof; and the colours of its heat map. */
import { decode, NumbersError } from "./numbers.ts";
import type { PlateCoverage } from "./view.ts";

/** Lightness, chroma and hue [deg] in Oklch, evenly spaced. */
const ANCHORS = [
  [0.26, 0.11, 300],
  [0.4, 0.11, 268],
  [0.54, 0.1, 222],
  [0.68, 0.11, 175],
  [0.82, 0.15, 128],
  [0.95, 0.14, 104],
] as const;

function gamma(linear: number): number {
  const x = Math.max(0, Math.min(1, linear));
  return x <= 0.0031308 ? 12.92 * x : 1.055 * x ** (1 / 2.4) - 0.055;
}

/** sRGB bytes of a colour in Oklab (B. Ottosson's matrices), clipped to what a screen shows. */
function bytesOf(lightness: number, a: number, b: number): [number, number, number] {
  const l = (lightness + 0.3963377774 * a + 0.2158037573 * b) ** 3;
  const m = (lightness - 0.1055613458 * a - 0.0638541728 * b) ** 3;
  const s = (lightness - 0.0894841775 * a - 1.291485548 * b) ** 3;
  const byte = (linear: number): number => Math.round(255 * gamma(linear));
  return [
    byte(4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s),
    byte(-1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s),
    byte(-0.0041960863 * l - 0.7034186147 * m + 1.707614701 * s),
  ];
}

function sample(share: number): [number, number, number] {
  const at = share * (ANCHORS.length - 1);
  const k = Math.min(ANCHORS.length - 2, Math.floor(at));
  const rest = at - k;
  const mixed = (component: 0 | 1 | 2): number => ANCHORS[k]![component] * (1 - rest) + ANCHORS[k + 1]![component] * rest;
  const hue = (mixed(2) * Math.PI) / 180;
  return bytesOf(mixed(0), mixed(1) * Math.cos(hue), mixed(1) * Math.sin(hue));
}

/**
 * `count` colours from share 0 to 1 as red, green, blue and alpha bytes: even steps in lightness from dark violet over teal to pale yellow,
 * legible without seeing red or green.
 */
export function colormap(count = 256): Uint8Array {
  const bytes = new Uint8Array(4 * count);
  for (let i = 0; i < count; i++) bytes.set([...sample(i / Math.max(1, count - 1)), 255], 4 * i);
  return bytes;
}

/** The map as CSS gradient, for a legend. */
export function cssGradient(): string {
  const stops = Array.from({ length: 9 }, (_, i) => `rgb(${sample(i / 8).join(" ")}) ${(100 * i) / 8}%`);
  return `linear-gradient(to right, ${stops.join(", ")})`;
}

/** A cell that the sponge never gets over. */
export const NEVER = 65535;
/** A cell with its middle beyond the rim. */
export const OUTSIDE = 65534;

/** A time after all others [s]. */
const LATER_S = 1e9;

/** When a cell counts that has this mark [s]: after all others for never, below 0 beyond the rim. */
export function timeOf(mark: number, step_s: number): number {
  if (mark === OUTSIDE) return -1;
  return mark === NEVER ? LATER_S : mark * step_s;
}

/** A raster as it is in the document, with its cells in the order in which they get swept. */
export interface Coverage extends Pick<PlateCoverage, "plate" | "half_m" | "counted" | "step_s" | "dwell_step_s" | "proved"> {
  rows: number;
  columns: number;
  first: Uint16Array;
  dwell: Uint8Array;
  /** Cells within the rim. */
  cells: number;
  /** Indices of the cells that get swept, earliest first. */
  order: Uint32Array;
  /** At k: how many cells are swept by step k, the step included; its last number holds ever after. */
  swept: Uint32Array;
}

function ordered(first: Uint16Array): { order: Uint32Array; swept: Uint32Array } {
  let last = -1;
  for (const step of first) if (step < OUTSIDE && step > last) last = step;
  const swept = new Uint32Array(last + 2);
  for (const step of first) if (step < OUTSIDE) swept[step + 1]!++;
  for (let k = 1; k < swept.length; k++) swept[k]! += swept[k - 1]!;
  const order = new Uint32Array(swept[last + 1]!);
  const at = swept.slice();
  first.forEach((step, cell) => {
    if (step < OUTSIDE) order[at[step]!++] = cell;
  });
  return { order, swept: swept.subarray(1) };
}

/** By the raster itself: a proof changes only what is said of it. */
const DECODED = new WeakMap<object, Coverage>();

/** Decodes a raster, once; `NumbersError` where its arrays do not fit each other. */
export function decodeCoverage(document: PlateCoverage): Coverage {
  const before = DECODED.get(document.first);
  if (before !== undefined) return before.proved === document.proved ? before : { ...before, proved: document.proved };
  const decoded = freshlyDecoded(document);
  DECODED.set(document.first, decoded);
  return decoded;
}

function freshlyDecoded(document: PlateCoverage): Coverage {
  const first = decode(document.first);
  const dwell = decode(document.dwell);
  const [rows = 0, columns = 0] = document.first.shape;
  if (!(first instanceof Uint16Array) || !(dwell instanceof Uint8Array)) {
    throw new NumbersError("coverage: first must be u16 and dwell u8");
  }
  if (document.first.shape.length !== 2 || first.length !== dwell.length) {
    throw new NumbersError(`coverage: first of shape ${document.first.shape.join("×")} and dwell of ${document.dwell.shape.join("×")}`);
  }
  let cells = 0;
  for (const step of first) if (step !== OUTSIDE) cells++;
  const { plate, half_m, counted, step_s, dwell_step_s, proved } = document;
  return { plate, rows, columns, half_m, counted, first, step_s, dwell, dwell_step_s, proved, cells, ...ordered(first) };
}

/** How many cells are swept at `t` [s]. */
function sweptAt(coverage: Coverage, t: number): number {
  if (!(t >= 0) || coverage.swept.length === 0) return 0;
  const step = Math.min(coverage.swept.length - 1, Math.floor(t / coverage.step_s + 1e-9));
  return coverage.swept[step]!;
}

/** The share of the plate's cells that are swept at `t` [s]; 0 where there are no cells. */
export function shareAt(coverage: Coverage, t: number): number {
  return coverage.cells === 0 ? 0 : sweptAt(coverage, t) / coverage.cells;
}

/** The time to which a heat map's scale goes [s]: 98 of 100 swept cells are washed no longer. */
export function dwellScale(coverages: readonly Coverage[]): number {
  let scale = 0;
  for (const coverage of coverages) {
    const count = new Uint32Array(256);
    for (const cell of coverage.order) count[coverage.dwell[cell]!]!++;
    let left = 0.02 * coverage.order.length;
    let steps = 255;
    while (steps > 1 && left >= count[steps]!) left -= count[steps--]!;
    if (coverage.order.length > 0) scale = Math.max(scale, steps * coverage.dwell_step_s);
  }
  return scale > 0 ? scale : 1;
}

/** What a map shows: how it builds up until a time, or for how long each place is washed in the end. */
export type MapMode = "build-up" | "dwell";

/** Red, green and blue bytes. */
export const MAP_COLOURS = { swept: [0, 114, 178], unswept: [203, 208, 214] };

const HEAT = colormap();

/** A small map of one plate, seen from above with x to the right. Painting costs what has changed since it was last painted. */
export class PlateMap {
  readonly coverage: Coverage;
  readonly #canvas: HTMLCanvasElement;
  readonly #context: CanvasRenderingContext2D | null;
  readonly #image: ImageData;
  /** Seconds at the hot end of a heat map. */
  readonly #scale_s: number;
  #painted = 0;
  #mode: MapMode | null = null;

  constructor(canvas: HTMLCanvasElement, coverage: Coverage, scale_s = dwellScale([coverage])) {
    this.coverage = coverage;
    this.#canvas = canvas;
    this.#canvas.width = Math.max(1, coverage.columns);
    this.#canvas.height = Math.max(1, coverage.rows);
    this.#context = canvas.getContext("2d");
    this.#image = new ImageData(this.#canvas.width, this.#canvas.height);
    this.#scale_s = scale_s;
  }

  /** Paints the map as it is at `t` [s]. */
  paint(t: number, mode: MapMode = "build-up"): void {
    const changed = mode === "dwell" ? this.#paintDwell() : this.#paintSwept(t);
    if (changed) this.#context?.putImageData(this.#image, 0, 0);
  }

  #paintSwept(t: number): boolean {
    const count = sweptAt(this.coverage, t);
    const anew = this.#mode !== "build-up";
    if (anew) {
      this.#mode = "build-up";
      this.#painted = 0;
      this.coverage.first.forEach((step, cell) => {
        if (step !== OUTSIDE) this.#set(cell, MAP_COLOURS.unswept, 0);
      });
    }
    const before = this.#painted;
    for (let k = before; k < count; k++) this.#set(this.coverage.order[k]!, MAP_COLOURS.swept, 0);
    for (let k = count; k < before; k++) this.#set(this.coverage.order[k]!, MAP_COLOURS.unswept, 0);
    this.#painted = count;
    return anew || before !== count;
  }

  #paintDwell(): boolean {
    if (this.#mode === "dwell") return false;
    this.#mode = "dwell";
    const perStep = (255 * this.coverage.dwell_step_s) / this.#scale_s;
    this.coverage.first.forEach((step, cell) => {
      if (step === OUTSIDE) return;
      if (step === NEVER) this.#set(cell, MAP_COLOURS.unswept, 0);
      else this.#set(cell, HEAT, 4 * Math.min(255, Math.round(this.coverage.dwell[cell]! * perStep)));
    });
    return true;
  }

  #set(cell: number, colours: ArrayLike<number>, at: number): void {
    const { rows, columns } = this.coverage;
    const y = Math.floor(cell / columns);
    const pixel = 4 * ((rows - 1 - y) * columns + (cell - y * columns));
    const data = this.#image.data;
    data[pixel] = colours[at]!;
    data[pixel + 1] = colours[at + 1]!;
    data[pixel + 2] = colours[at + 2]!;
    data[pixel + 3] = 255;
  }
}

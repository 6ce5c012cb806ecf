import assert from "node:assert/strict";
import { test } from "node:test";
import { colormap, decodeCoverage, dwellScale, MAP_COLOURS, NEVER, OUTSIDE, PlateMap, shareAt } from "../src/coverage.ts";
import { NumbersError } from "../src/numbers.ts";
import type { Numbers, PlateCoverage } from "../src/view.ts";

function u16(values: number[], shape: number[]): Numbers {
  return { shape, u16: Buffer.from(Uint16Array.from(values).buffer).toString("base64") };
}

function u8(values: number[], shape: number[]): Numbers {
  return { shape, u8: Buffer.from(Uint8Array.from(values)).toString("base64") };
}

/** Two rows of three cells: one beyond the rim, one never swept. */
function raster(first = [OUTSIDE, 3, 0, 3, NEVER, 10], dwell = [0, 4, 1, 2, 0, 200]): PlateCoverage {
  return { plate: 0, half_m: 0.1, counted: null, first: u16(first, [2, 3]), step_s: 0.1, dwell: u8(dwell, [2, 3]), dwell_step_s: 0.05, proved: null };
}

test("the share grows by the cells that are swept, of those within the rim", () => {
  const coverage = decodeCoverage(raster());
  const shares = [-1, 0, 0.29, 0.3, 0.99, 1, 1e9].map((t) => shareAt(coverage, t));
  assert.deepEqual(shares, [0, 0.2, 0.2, 0.6, 0.6, 0.8, 0.8]);
  assert.equal(shareAt(coverage, Number.NaN), 0);
});

test("cells come in the order in which they are swept", () => {
  assert.deepEqual([...decodeCoverage(raster()).order], [2, 1, 3, 5]);
});

test("the share of an unswept plate stays 0", () => {
  const never = decodeCoverage(raster([OUTSIDE, NEVER, NEVER, NEVER, NEVER, NEVER], [0, 0, 0, 0, 0, 0]));
  assert.equal(shareAt(never, 1e9), 0);
  assert.equal(dwellScale([never]), 1);
  const nothing = decodeCoverage(raster([OUTSIDE, OUTSIDE, OUTSIDE, OUTSIDE, OUTSIDE, OUTSIDE]));
  assert.equal(shareAt(nothing, 1), 0);
  assert.equal(dwellScale([]), 1);
});

test("the heat map's scale leaves out the longest fiftieth", () => {
  const count = 100;
  const dwell = Array.from({ length: count }, (_, i) => (i < 2 ? 250 : 1 + (i % 10)));
  const document: PlateCoverage = {
    ...raster(),
    first: u16(new Array<number>(count).fill(1), [10, 10]),
    dwell: u8(dwell, [10, 10]),
  };
  assert.equal(dwellScale([decodeCoverage(document)]), 10 * 0.05);
});

test("rasters that do not fit each other are refused", () => {
  assert.throws(() => decodeCoverage({ ...raster(), dwell: u8([1, 2], [1, 2]) }), NumbersError);
  assert.throws(() => decodeCoverage({ ...raster(), first: u8([1, 2, 3, 4, 5, 6], [2, 3]) }), NumbersError);
  assert.throws(() => decodeCoverage({ ...raster(), first: u16([1, 2, 3, 4, 5, 6], [6]) }), NumbersError);
});

/** A canvas that keeps what is put on it. */
class FakeCanvas {
  width = 0;
  height = 0;
  pixels: number[] = [];
  puts = 0;

  getContext(): { putImageData(image: { data: Uint8ClampedArray }): void } {
    return {
      putImageData: (image) => {
        this.pixels = [...image.data];
        this.puts++;
      },
    };
  }
}

class FakeImage {
  readonly data: Uint8ClampedArray;

  constructor(width: number, height: number) {
    this.data = new Uint8ClampedArray(4 * width * height);
  }
}

const [SWEPT, UNSWEPT] = [MAP_COLOURS.swept[1]!, MAP_COLOURS.unswept[1]!];

function mapOf(document: PlateCoverage): { map: PlateMap; canvas: FakeCanvas } {
  Object.assign(globalThis, { ImageData: FakeImage });
  const canvas = new FakeCanvas();
  const map = new PlateMap(canvas as unknown as HTMLCanvasElement, decodeCoverage(document), 0.2);
  return { map, canvas };
}

/** Green of each pixel. */
function greens(canvas: FakeCanvas): number[] {
  return canvas.pixels.filter((_, i) => i % 4 === 1);
}

test("a map shows y upwards and nothing beyond the rim, at any time", () => {
  const { map, canvas } = mapOf(raster());
  map.paint(0.3);
  assert.deepEqual([canvas.width, canvas.height], [3, 2]);
  assert.deepEqual(greens(canvas), [SWEPT, UNSWEPT, UNSWEPT, 0, SWEPT, SWEPT]);
  assert.deepEqual(canvas.pixels.filter((_, i) => i % 4 === 3), [255, 255, 255, 0, 255, 255]);
  map.paint(0);
  assert.deepEqual(greens(canvas), [UNSWEPT, UNSWEPT, UNSWEPT, 0, UNSWEPT, SWEPT]);
  map.paint(5);
  assert.deepEqual(greens(canvas), [SWEPT, UNSWEPT, SWEPT, 0, SWEPT, SWEPT]);
});

test("an unchanged map is not drawn again", () => {
  const { map, canvas } = mapOf(raster());
  map.paint(0.3);
  map.paint(0.4);
  assert.equal(canvas.puts, 1);
});

test("a heat map colours dwell and leaves what is never swept", () => {
  const { map, canvas } = mapOf(raster());
  map.paint(0, "dwell");
  const heat = colormap();
  const green = (share: number): number => heat[4 * Math.round(255 * share) + 1]!;
  assert.deepEqual(greens(canvas), [green(0.5), UNSWEPT, green(1), 0, green(1), green(0.25)]);
  map.paint(0, "dwell");
  assert.equal(canvas.puts, 1);
  map.paint(0);
  assert.deepEqual(greens(canvas), [UNSWEPT, UNSWEPT, UNSWEPT, 0, UNSWEPT, SWEPT]);
});

test("the colours of a heat map get lighter all the way", () => {
  const map = colormap(64);
  const linear = (byte: number): number => ((byte / 255 + 0.055) / 1.055) ** 2.4;
  let before = -1;
  for (let i = 0; i < 64; i++) {
    const luminance = 0.2126 * linear(map[4 * i]!) + 0.7152 * linear(map[4 * i + 1]!) + 0.0722 * linear(map[4 * i + 2]!);
    assert.ok(luminance > before, `colour ${i}`);
    before = luminance;
  }
});

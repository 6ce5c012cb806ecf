import assert from "node:assert/strict";
import { test } from "node:test";
import { simplified, stretches } from "../src/scene/lines.ts";

/** Distance of a place from the nearest stretch of a polyline. */
function distance(place: number[], line: Float64Array): number {
  let nearest = Infinity;
  for (let i = 0; i + 5 < line.length; i += 3) {
    const from = [...line.subarray(i, i + 3)];
    const span = [...line.subarray(i + 3, i + 6)].map((x, k) => x - from[k]!);
    const offset = place.map((x, k) => x - from[k]!);
    const length = span.reduce((sum, x) => sum + x * x, 0);
    const along = length === 0 ? 0 : span.reduce((sum, x, k) => sum + x * offset[k]!, 0) / length;
    const share = Math.max(0, Math.min(1, along));
    nearest = Math.min(nearest, Math.hypot(...offset.map((x, k) => x - share * span[k]!)));
  }
  return nearest;
}

test("a simplified spiral has fewer places, its ends, and stays within the tolerance", () => {
  const places: number[] = [];
  for (let i = 0; i <= 2000; i++) {
    const angle = (i / 2000) * 8 * Math.PI;
    const radius = 0.145 * (i / 2000);
    places.push(radius * Math.cos(angle), radius * Math.sin(angle), 0.03);
  }
  const few = simplified(places, 1e-4);
  assert.ok(few.length < places.length / 5, `${few.length / 3} places`);
  assert.deepEqual([...few.subarray(0, 3), ...few.subarray(-3)], [...places.slice(0, 3), ...places.slice(-3)]);
  for (let i = 0; i < places.length; i += 21) {
    const away = distance(places.slice(i, i + 3), few);
    assert.ok(away <= 1e-4 + 1e-12, `place ${i / 3}: ${away} m`);
  }
});

test("what is too short to simplify stays as it is, a way to and fro keeps its turn", () => {
  assert.equal(simplified([], 1e-3).length, 0);
  assert.deepEqual([...simplified([1, 2, 3], 1e-3)], [1, 2, 3]);
  assert.deepEqual([...simplified([0, 0, 0, 1, 0, 0, 0, 0, 0], 1e-3)], [0, 0, 0, 1, 0, 0, 0, 0, 0]);
});

test("stretches join the places of each polyline, and none across a place that is not finite", () => {
  const ends = stretches([[0, 0, 0, 1, 0, 0, 2, 0, 0], [5, 5, 5], [3, 0, 0, Number.NaN, 0, 0, 4, 0, 0, 4, 1, 0]]);
  assert.deepEqual([...ends], [0, 0, 0, 1, 0, 0, 1, 0, 0, 2, 0, 0, 4, 0, 0, 4, 1, 0]);
});

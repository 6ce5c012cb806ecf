import assert from "node:assert/strict";
import { test } from "node:test";
import { BufferGeometry, SphereGeometry } from "three";
import { geometryOf, segmentsOfQuarter, segmentsRound } from "../src/scene/shapes.ts";
import type { Shape } from "../src/view.ts";

function meshOf(geometry: BufferGeometry): Shape {
  const corners = Float32Array.from(geometry.toNonIndexed().getAttribute("position").array);
  return { mesh: { triangles: { shape: [corners.length / 9, 3, 3], f32: Buffer.from(corners.buffer).toString("base64") } } };
}

test("a mesh of a hundred thousand corners states each once, in little time", () => {
  const shape = meshOf(new SphereGeometry(1, 130, 130));
  const begun = performance.now();
  const slim = geometryOf(shape, "exact");
  assert.ok(performance.now() - begun < 2000, `${performance.now() - begun} ms`);
  assert.equal(slim.index!.count, 3 * 2 * 130 * 129);
  assert.ok(slim.getAttribute("position").count < slim.index!.count / 4);
});

test("chords keep to 0.12 mm of their arcs where there may be enough of them, and circles are as wide as they should be", () => {
  for (const radius of [0.001, 0.005, 0.02, 0.05, 0.0625]) {
    const segments = segmentsRound(radius, 48);
    assert.equal(segments % 4, 0);
    assert.ok(segments === 48 || radius * (1 - Math.cos(Math.PI / segments)) <= 0.00012, `${radius}: ${segments}`);
    const steps = segmentsOfQuarter(radius, 64);
    assert.ok(radius * (1 - Math.cos(Math.PI / 4 / steps)) <= 0.00012 + 1e-12, `${radius}: ${steps}`);
  }
  for (const odd of [0, -1, Number.NaN, Infinity, 1e9]) {
    assert.ok([16, 48].includes(segmentsRound(odd, 48)), `${odd}`);
    assert.ok([1, 4].includes(segmentsOfQuarter(odd, 4)), `${odd}`);
  }
});

import assert from "node:assert/strict";
import { test } from "node:test";
import { BufferAttribute, BufferGeometry, LatheGeometry, SphereGeometry, Vector2 } from "three";
import { RoundedBoxGeometry } from "three/examples/jsm/geometries/RoundedBoxGeometry.js";
import { indexed } from "../src/scene/indexed.ts";
import { segmentsOfQuarter, segmentsRound } from "../src/scene/round.ts";

/** Corners of all triangles in order: places and normals. */
function corners(geometry: BufferGeometry): number[][] {
  const [place, normal] = ["position", "normal"].map((name) => geometry.getAttribute(name));
  const count = geometry.index?.count ?? place!.count;
  return Array.from({ length: count }, (_, at) => {
    const i = geometry.index?.getX(at) ?? at;
    return [place!, normal!].flatMap((attribute) => [attribute.getX(i), attribute.getY(i), attribute.getZ(i)].map((x) => x + 0));
  });
}

/** Triangles of which no two corners are the same. */
function whole(list: number[][]): number[][] {
  const same = (a: number[], b: number[]): boolean => a.every((x, k) => x === b[k]);
  return list.filter((_, at) => {
    const [a, b, c] = list.slice(at - (at % 3), at - (at % 3) + 3) as [number[], number[], number[]];
    return !same(a, b) && !same(b, c) && !same(c, a);
  });
}

test("an index leaves every triangle that has an area where it was, corner by corner", () => {
  const lathe = new LatheGeometry([[0, 0], [0.1, 0], [0.1, 0], [0.1, 0.2], [0, 0.2]].map(([x, y]) => new Vector2(x, y)), 24);
  for (const geometry of [new RoundedBoxGeometry(0.1, 0.2, 0.3, 2, 0.004), new SphereGeometry(0.1, 16, 8), lathe]) {
    geometry.deleteAttribute("uv");
    const slim = indexed(geometry);
    assert.deepEqual(corners(slim), whole(corners(geometry)));
    const states = new Set(corners(slim).map(String));
    assert.equal(slim.getAttribute("position").count, states.size, "a corner is stated twice");
    assert.ok(slim.getAttribute("position").count < geometry.getAttribute("position").count);
  }
});

test("corners that differ in one attribute alone stay apart; -0 is 0", () => {
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(new Float32Array([0, 0, 0, 1, 0, 0, 0, 1, 0, -0, 0, 0, 1, 0, 0, 0, 1, 0]), 3));
  assert.equal(indexed(geometry).getAttribute("position").count, 3);
  geometry.setAttribute("face", new BufferAttribute(new Float32Array([0, 0, 0, 1, 0, 0]), 1));
  assert.equal(indexed(geometry).getAttribute("position").count, 4);
});

test("nothing is left of nothing, and NaN ends", () => {
  assert.equal(indexed(new BufferGeometry()).getAttribute("position"), undefined);
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(new Float32Array(18).fill(Number.NaN), 3));
  assert.equal(indexed(geometry).index?.count, 0);
  geometry.setAttribute("position", new BufferAttribute(new Float32Array(0), 3));
  assert.equal(indexed(geometry).index?.count, 0);
});

test("a mesh of a hundred thousand corners is indexed in little time", () => {
  const geometry = new SphereGeometry(1, 130, 130).toNonIndexed();
  geometry.deleteAttribute("uv");
  const begun = performance.now();
  const slim = indexed(geometry);
  assert.ok(performance.now() - begun < 2000, `${performance.now() - begun} ms`);
  assert.ok(slim.getAttribute("position").count < geometry.getAttribute("position").count / 4);
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

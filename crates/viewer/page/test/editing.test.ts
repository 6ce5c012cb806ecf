import assert from "node:assert/strict";
import { test } from "node:test";
import { Matrix4, Ray, Vector3 } from "three";
import { carried, type Centre, type Grab, middle, nearest, onPlane, type Solid, turnOf } from "../src/scene/handles.ts";
import { squaresOf } from "../src/scene/map.ts";
import { arrowsOf, partOf, ringThrough } from "../src/scene/ring.ts";
import { CELLS, deadNearer } from "../src/scene/washability.ts";

function ray(from: [number, number, number], to: [number, number, number]): Ray {
  const origin = new Vector3(...from);
  return new Ray(origin, new Vector3(...to).sub(origin).normalize());
}

test("a ray meets a level plane where it is aimed at, and nowhere behind the eye, along the plane or far off", () => {
  const found = onPlane(ray([1, -2, 3], [0.25, 0.5, 0.03]), 0.03);
  assert.ok(found !== null && Math.abs(found[0] - 0.25) < 1e-12 && Math.abs(found[1] - 0.5) < 1e-12);
  assert.equal(onPlane(ray([0, 0, 1], [0, 0, 2]), 0), null);
  assert.equal(onPlane(ray([0, 0, 1], [1, 0, 1]), 0), null);
  assert.equal(onPlane(ray([0, 0, 1], [100, 0, 0]), 0), null);
  assert.equal(onPlane(ray([0, 0, 1], [0, 0, 0]), Number.NaN), null);
});

function solid(x: number, y: number, z = 0.03): Solid {
  return { pose: new Matrix4().makeTranslation(x, y, z), rim_m: 0.145, top_m: 0, bottom_m: -0.02 };
}

test("a ray meets the plate that is in front, on its face or its side", () => {
  const solids = [solid(0, 0), solid(0.3, 0)];
  assert.equal(nearest(ray([0.1, 0, 1], [0.1, 0, 0]), solids), 0);
  assert.equal(nearest(ray([0.3, 0.144, 1], [0.3, 0.144, 0]), solids), 1);
  assert.equal(nearest(ray([0.3, 0.146, 1], [0.3, 0.146, 0]), solids), null);
  // Level, through both: the nearer side counts.
  assert.equal(nearest(ray([2, 0, 0.02], [-2, 0, 0.02]), solids), 1);
  assert.equal(nearest(ray([2, 0, 0.04], [-2, 0, 0.04]), solids), null);
  assert.equal(nearest(ray([0, 0, 1], [0, 0, 2]), solids), null);
  assert.equal(nearest(ray([0, 0, 1], [0, 0, 0]), [{ ...solid(0, 0), rim_m: Number.NaN }]), null);
});

function grab(starts_m: Centre[], from_m: Centre, about_m: Centre | null = null): Grab {
  return { plates: starts_m.map((_, k) => k), starts_m, from_m, about_m };
}

test("one plate comes to lie on whole millimetres, or on tenths where it is wanted finer", () => {
  const one = grab([[0.26579354, -0.19442417]], [0.3, -0.2]);
  assert.deepEqual(carried(one, [0.31234, -0.2], false), [[0.278, -0.194]]);
  assert.deepEqual(carried(one, [0.31234, -0.2], true), [[0.2781, -0.1944]]);
  assert.ok(!Object.is(carried(grab([[0.0004, 0]], [0, 0]), [-0.0006, 0], false)![0]![0], -0), "no minus nought");
});

test("plates that are shifted together keep how they lie to each other", () => {
  const starts: Centre[] = [[0.26579354, -0.19442417], [0.10447402, 0.35781245]];
  const ends = carried(grab(starts, [0, 0]), [0.0234, -0.0117], false)!;
  ends.forEach(([x, y], k) => {
    assert.ok(Math.abs(x - starts[k]![0] - 0.023) < 1e-9 && Math.abs(y - starts[k]![1] + 0.012) < 1e-9);
  });
  assert.equal(carried(grab(starts, [0, 0]), [11, 0], false), null);
  assert.equal(carried(grab(starts, [0, 0]), [Number.NaN, 0], false), null);
});

test("a turn goes by half degrees about the base axis, and coordinates by tenths of millimetres", () => {
  const about: Centre = [0.1, -0.05];
  const degrees = (angle: number): Centre => [about[0] + 0.4 * Math.cos((angle * Math.PI) / 180), about[1] + 0.4 * Math.sin((angle * Math.PI) / 180)];
  assert.ok(Math.abs(turnOf(about, degrees(10), degrees(40.3), false) - (30.5 * Math.PI) / 180) < 1e-12);
  assert.ok(Math.abs(turnOf(about, degrees(170), degrees(-170), false) - (20 * Math.PI) / 180) < 1e-12, "the short way round");
  const start: Centre = [0.41234567, 0.02];
  const [end] = carried(grab([start], degrees(0), about), degrees(90.1), false)!;
  assert.deepEqual(end, [0.03, 0.2623]);
  assert.deepEqual(carried(grab([start], degrees(0), about), degrees(0.2), false), [start], "no turn leaves the centre as it was");
  assert.deepEqual(carried(grab([about], degrees(0), about), degrees(45), false), [about]);
});

test("the ring goes through the centre, its arrows beside the plate; there is none about the axis itself", () => {
  const ring = ringThrough([0, 0], [0.3, 0.4], 0.145)!;
  assert.ok(Math.abs(ring.radius_m - 0.5) < 1e-12);
  for (const arrow of arrowsOf(ring)) {
    assert.ok(Math.abs(Math.hypot(...arrow) - 0.5) < 1e-12 && Math.hypot(arrow[0] - 0.3, arrow[1] - 0.4) > 0.15);
    assert.equal(partOf(ring, arrow, 0.005), "arrow");
  }
  assert.equal(partOf(ring, [0, -0.503], 0.005), "line");
  assert.equal(partOf(ring, [0, -0.51], 0.005), null);
  assert.equal(ringThrough([0.2, 0.2], [0.21, 0.2], 0.145), null);
  assert.equal(ringThrough([0, 0], [Number.NaN, 0], 0.1), null);
  assert.deepEqual(middle([[0, 0], [0.2, 0.4]]), [0.1, 0.2]);
  assert.deepEqual(middle([]), [0, 0]);
});

/** What `deadNearer` finds, by looking at all points for each cell. */
function plainly(free: number[][], dead: number[][], half: number): Uint8Array {
  const least = (points: number[][], x: number, y: number): number => Math.min(Infinity, ...points.map((p) => (p[0]! - x) ** 2 + (p[1]! - y) ** 2));
  return Uint8Array.from({ length: CELLS * CELLS }, (_, k) => {
    const [x, y] = [k % CELLS, Math.floor(k / CELLS)].map((i) => ((2 * i + 1) / CELLS - 1) * half) as [number, number];
    return least(dead, x, y) < least(free, x, y) ? 255 : 0;
  });
}

test("a position belongs to the nearest point", () => {
  const spiral = Array.from({ length: 120 }, (_, i) => [0.001 * i * Math.cos(i / 5), 0.001 * i * Math.sin(i / 5)]);
  const cases: [number[][], number[][]][] = [
    [spiral.slice(0, 70), spiral.slice(70)],
    [[[0.01, 0.02]], [[-0.13, -0.1]]],
    [spiral.map(([x, y]) => [0.12 + x! / 50, y! / 50]), [[-0.1, 0]]],
    [[], [[0, 0]]],
    [[[0.2, 0.2], [0, 0]], [[-0.2, 0.1]]],
  ];
  for (const [free, dead] of cases) assert.deepEqual(deadNearer(free, dead, 0.145), plainly(free, dead, 0.145));
});

test("no area is dead without dead points, at equal distances or for NaN", () => {
  const none = (free: number[][], dead: number[][], half = 0.145): boolean => deadNearer(free, dead, half).every((cell) => cell === 0);
  assert.ok(none([[0, 0]], []));
  assert.ok(none([[0.01, 0.01]], [[0.01, 0.01]]));
  assert.ok(none([[0, 0]], [[Number.NaN, 0], [0, Infinity], [5, 5], []]));
  assert.ok(none([], [[0, 0]], Number.NaN));
});

test("finer squares of the map come before coarse ones, however they came", () => {
  const squares = squaresOf([
    { step_m: 0.1, washable_m: [[0, 0]], unwashable_m: [[0.1, 0], [Number.NaN, 0], [1e9, 0]] },
    { step_m: 0.05, washable_m: [], unwashable_m: [[0.025, 0.025]] },
    { step_m: Number.NaN, washable_m: [[0, 0]], unwashable_m: [] },
  ]);
  const expected = [0.025, 0.025, 0.05, 0, 0, 0, 0.1, 1, 0.1, 0, 0.1, 0];
  assert.deepEqual([...squares], [...Float32Array.from(expected)]);
  assert.equal(squaresOf([]).length, 0);
});

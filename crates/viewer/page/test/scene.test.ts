import assert from "node:assert/strict";
import { test } from "node:test";
import { BufferGeometry, Matrix4, SphereGeometry, Vector3 } from "three";
import { Kinematics } from "../src/motion.ts";
import { ArmGraph } from "../src/scene/arm.ts";
import { marksHeight, patchAt } from "../src/scene/floor.ts";
import { simplified, stretches } from "../src/scene/lines.ts";
import { geometryOf, plateGeometry, segmentsOfQuarter, segmentsRound } from "../src/scene/shapes.ts";
import { Studio } from "../src/scene/stage.ts";
import { ToolGraph } from "../src/scene/tool.ts";
import { clusters, MARK_PX } from "../src/shell/transport.ts";
import type { Check, Plate, Shape, Status, Tool, ToolBody } from "../src/view.ts";
import { irb120, pose, TOOL } from "./irb120.ts";

const HANDLE: ToolBody = { name: "handle", shape: { cylinder: { radius_m: 0.02, half_length_m: 0.0625 } }, pose: pose([0, 0, 0.0625]) };
const HELD: Tool = { ...TOOL, bodies: [HANDLE] };

function graphs(plates: Plate[]): { arm: ArmGraph; tool: ToolGraph } {
  const studio = new Studio();
  const arm = new ArmGraph(irb120(pose([0.1, -0.2, 0.3], [0.5, 0.5, 0.5, 0.5])), studio);
  const tool = new ToolGraph(HELD, plates, studio);
  arm.flange.add(tool.root);
  return { arm, tool };
}

test("the tip of the scene graph is that of the kinematics", () => {
  const { arm, tool } = graphs([]);
  const kinematics = new Kinematics(irb120(pose([0.1, -0.2, 0.3], [0.5, 0.5, 0.5, 0.5])), HELD);
  for (const q of [[0, 0, 0, 0, 0, 0], [0.3, -0.7, 1.1, -1.9, 0.4, 2.8], [-2, 1, -1, 0.5, -1.5, -6]]) {
    arm.set(q);
    arm.root.updateMatrixWorld(true);
    const tip = kinematics.tip(q, new Matrix4()).elements;
    tool.tip.matrixWorld.elements.forEach((value, i) => assert.ok(Math.abs(value - tip[i]!) < 1e-14, `${q}: element ${i}`));
  }
});

/** The tool alone, pointing down, its tip at a height over a plate and at a distance from its axis [m]. */
function pressedAt(height: number, distance: number): number {
  const plate: Plate = { name: "plate", pose: pose([1, 0, 0.5]), surface: { meridian: "disc", radius_m: 0.145 }, meridian_m: [[0, 0], [0.1, 0], [0.145, 0.02]], thickness_m: 0.02 };
  const tool = new ToolGraph(HELD, [plate], new Studio());
  tool.root.rotation.x = Math.PI;
  tool.root.position.set(1 + distance, 0, 0.5 + height + 0.15);
  tool.root.updateMatrixWorld(true);
  tool.press();
  return tool.pressed_m;
}

test("the sponge is pressed in where its tip is within the compression of a face", () => {
  const cases = [
    { height: 0, distance: 0, pressed: 0.005 },
    { height: 0.002, distance: 0.05, pressed: 0.003 },
    { height: 0.006, distance: 0, pressed: 0 },
    { height: -0.001, distance: 0, pressed: 0.005 },
    { height: -0.03, distance: 0, pressed: 0 },
    { height: 0, distance: 0.2, pressed: 0 },
    { height: 0.01, distance: 0.1225, pressed: 0.005 },
  ];
  for (const { height, distance, pressed } of cases) {
    const found = pressedAt(height, distance);
    assert.ok(Math.abs(found - pressed) < 1e-8, `${height} m high, ${distance} m off: ${found} m instead of ${pressed}`);
  }
});

test("every shape has triangles that keep to its size", () => {
  const shapes: [Shape, [number, number, number]][] = [
    [{ box: { half_m: [0.1, 0.2, 0.3] } }, [0.1, 0.2, 0.3]],
    [{ cylinder: { radius_m: 0.1, half_length_m: 0.3 } }, [0.1, 0.1, 0.3]],
    [{ sphere: { radius_m: 0.2 } }, [0.2, 0.2, 0.2]],
    [{ capsule: { radius_m: 0.1, half_length_m: 0.3 } }, [0.1, 0.1, 0.4]],
    [{ hull: { points: [[0.1, 0.2, 0.3], [-0.1, -0.2, -0.3], [-0.1, 0.2, -0.3], [0.1, -0.2, 0.3], [-0.1, -0.2, 0.3]] } }, [0.1, 0.2, 0.3]],
  ];
  for (const [shape, half] of shapes) {
    for (const edges of ["exact", "rounded"] as const) {
      const geometry = geometryOf(shape, edges);
      geometry.computeBoundingBox();
      const size = geometry.boundingBox!.getSize(new Vector3()).toArray();
      size.forEach((length, k) => assert.ok(Math.abs(length - 2 * half[k]!) < 1e-3 * half[k]!, `${JSON.stringify(shape)}: ${size}`));
      assert.ok([...geometry.getAttribute("normal").array].every(Number.isFinite));
    }
  }
});

test("shapes that cannot be drawn leave nothing rather than fail", () => {
  const flat: Shape = { hull: { points: [[0, 0, 0], [1, 0, 0], [0, 1, 0]] } };
  assert.equal(geometryOf(flat, "exact").getAttribute("position"), undefined);
  const none: Shape = { box: { half_m: [Number.NaN, Infinity, -1] } };
  assert.ok([...geometryOf(none, "rounded").getAttribute("position").array].every(Number.isFinite));
});

test("a plate's face is its meridian and looks up", () => {
  const plate: Plate = { name: "plate", pose: pose([0, 0, 0]), surface: { meridian: "disc", radius_m: 0.145 }, meridian_m: [[0, 0], [0.145, 0]], thickness_m: 0.02 };
  const geometry = plateGeometry(plate, 32);
  const [place, normal, face] = ["position", "normal", "face"].map((name) => geometry.getAttribute(name));
  let area = 0;
  for (let i = 0; i < face!.count; i++) {
    if (face!.getX(i) === 0) continue;
    area++;
    assert.ok(Math.abs(place!.getZ(i)) < 1e-8 && normal!.getZ(i) > 0.99, `corner ${i}`);
  }
  assert.ok(area > 0);
  geometry.computeBoundingBox();
  const { min, max } = geometry.boundingBox!;
  assert.ok(Math.abs(max.x - 0.145) < 1e-6 && Math.abs(min.z + 0.02) < 1e-6 && Math.abs(max.z) < 1e-6);
});

test("the patch is below an arm on the floor, and the marks under the plates where these lie level", () => {
  const on = (at: [number, number, number], quaternion?: [number, number, number, number]): { arm: ReturnType<typeof irb120> } => ({ arm: irb120(pose(at, quaternion)) });
  assert.deepEqual(patchAt(on([0, 0, 0])), [0, 0]);
  assert.deepEqual(patchAt(on([1, 2, 0], [Math.SQRT1_2, 0, 0, Math.SQRT1_2])), [1, 2]);
  assert.equal(patchAt(on([1, 2, 0.7])), null);
  assert.equal(patchAt(on([0, 0, 0], [0, 1, 0, 0])), null);
  const plate = (z: number, tilted = false): Plate => ({ name: "p", pose: pose([0.3, 0, z], tilted ? [Math.SQRT1_2, Math.SQRT1_2, 0, 0] : undefined), surface: { meridian: "disc", radius_m: 0.1 }, meridian_m: [[0, 0], [0.1, 0]], thickness_m: 0.02 });
  const height = (...plates: Plate[]): number => Number(marksHeight({ plates }).toFixed(6));
  assert.deepEqual([height(), height(plate(0.03)), height(plate(0.72), plate(0.92)), height(plate(0.72, true))], [0.0015, 0.0015, 0.7015, 0.0015]);
});

function check(words: string, time_s: number | null, status: Status = "proved"): Check {
  return { requirement: words, words, status, detail: "", worst: time_s === null ? {} : { time_s }, place: "", why: { sentence: "", group: "Within limits", place: 1, section: "", formulas: [], limit: "" } };
}

test("marks that would cover each other are one, at the worst of them", () => {
  const checks = [check("a", 1), check("b", 1.5, "violated"), check("c", 8), check("d", 2, "not_proved"), check("e", null)];
  const groups = clusters(checks, 10, 10 * MARK_PX);
  assert.deepEqual(groups.map((group) => group.checks.map(({ words }) => words)), [["b", "d", "a"], ["c"]]);
  assert.deepEqual(groups.map(({ time, status }) => [time, status]), [[1.5, "violated"], [8, "proved"]]);
});

test("no two marks overlap, wherever the worst places lie", () => {
  const statuses: Status[] = ["proved", "violated", "not_proved", "waived"];
  const checks = Array.from({ length: 60 }, (_, k) => check(`${k}`, (k * 7.31) % 40, statuses[(k * 5) % 4]!));
  for (const width of [200, 340, 900]) {
    const groups = clusters(checks, 40, width);
    groups.slice(1).forEach((group, k) => assert.ok(((group.time - groups[k]!.time) * width) / 40 >= MARK_PX));
    assert.equal(groups.reduce((sum, group) => sum + group.checks.length, 0), checks.length);
  }
});

test("times outside the film, or no width, make no trouble", () => {
  assert.deepEqual(clusters([check("a", -1), check("b", 99), check("c", Number.NaN)], 10, 100), []);
  assert.equal(clusters([check("a", 1), check("b", 9)], 10, 0).length, 1);
});

function meshOf(geometry: BufferGeometry): Shape {
  const corners = Float32Array.from(geometry.toNonIndexed().getAttribute("position").array);
  return { mesh: { triangles: { shape: [corners.length / 9, 3, 3], f32: Buffer.from(corners.buffer).toString("base64") } } };
}

test("a mesh of a hundred thousand corners states each once", () => {
  const slim = geometryOf(meshOf(new SphereGeometry(1, 130, 130)), "exact");
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

test("short polylines stay unchanged and a way to and fro keeps its turn", () => {
  assert.equal(simplified([], 1e-3).length, 0);
  assert.deepEqual([...simplified([1, 2, 3], 1e-3)], [1, 2, 3]);
  assert.deepEqual([...simplified([0, 0, 0, 1, 0, 0, 0, 0, 0], 1e-3)], [0, 0, 0, 1, 0, 0, 0, 0, 0]);
});

test("stretches join the places of each polyline, and none across a place that is not finite", () => {
  const ends = stretches([[0, 0, 0, 1, 0, 0, 2, 0, 0], [5, 5, 5], [3, 0, 0, Number.NaN, 0, 0, 4, 0, 0, 4, 1, 0]]);
  assert.deepEqual([...ends], [0, 0, 0, 1, 0, 0, 1, 0, 0, 2, 0, 0, 4, 0, 0, 4, 1, 0]);
});

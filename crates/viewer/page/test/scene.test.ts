import assert from "node:assert/strict";
import { test } from "node:test";
import { Matrix4, Vector3 } from "three";
import { Kinematics } from "../src/kinematics.ts";
import { ArmGraph } from "../src/scene/arm.ts";
import { geometryOf, plateGeometry } from "../src/scene/shapes.ts";
import { marksHeight, patchAt } from "../src/scene/floor.ts";
import { Studio } from "../src/scene/studio.ts";
import { ToolGraph } from "../src/scene/tool.ts";
import type { Body, Plate, Shape, Tool } from "../src/view.ts";
import { irb120, pose, TOOL } from "./irb120.ts";

const HANDLE: Body = { shape: { cylinder: { radius_m: 0.02, half_length_m: 0.0625 } }, pose: pose([0, 0, 0.0625]) };
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
  const plate: Plate = { name: "plate", pose: pose([1, 0, 0.5]), meridian_m: [[0, 0], [0.1, 0], [0.145, 0.02]], thickness_m: 0.02 };
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
  const plate: Plate = { name: "plate", pose: pose([0, 0, 0]), meridian_m: [[0, 0], [0.145, 0]], thickness_m: 0.02 };
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
  const plate = (z: number, tilted = false): Plate => ({ name: "p", pose: pose([0.3, 0, z], tilted ? [Math.SQRT1_2, Math.SQRT1_2, 0, 0] : undefined), meridian_m: [[0, 0], [0.1, 0]], thickness_m: 0.02 });
  const height = (...plates: Plate[]): number => Number(marksHeight({ plates }).toFixed(6));
  assert.deepEqual([height(), height(plate(0.03)), height(plate(0.72), plate(0.92)), height(plate(0.72, true))], [0.0015, 0.0015, 0.7015, 0.0015]);
});

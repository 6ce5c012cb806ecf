import assert from "node:assert/strict";
import { test } from "node:test";
import { Matrix4 } from "three";
import { Kinematics, matrixOf } from "../src/kinematics.ts";
import { irb120, pose, TOOL } from "./irb120.ts";

/** Joints [deg], flange's place [m] and z axis as `platewash fk --deg … --json` states them. */
const STATED = [
  { deg: [0, 0, 0, 0, 90, 0], place: [0.302, 0, 0.558], z: [0, 0, -1] },
  {
    deg: [10, -20, 30, 40, 50, 60],
    place: [0.24542519426395834, 0.07927508349435225, 0.510565798391811],
    z: [0.4375473263044909, 0.5771513989643324, -0.689527809386471],
  },
];

function near(actual: ArrayLike<number>, expected: readonly number[], tolerance = 1e-14): void {
  expected.forEach((value, i) => assert.ok(Math.abs(actual[i]! - value) <= tolerance, `${i}: ${actual[i]} instead of ${value}`));
}

test("the flange is where platewash has it", () => {
  const kinematics = new Kinematics(irb120(pose([0, 0, 0])), null);
  for (const { deg, place, z } of STATED) {
    const flange = kinematics.tip(deg.map((angle) => (angle * Math.PI) / 180), new Matrix4()).elements;
    near(flange.slice(12, 15), place);
    near(flange.slice(8, 11), z);
  }
});

test("the tip stands off the flange along its z axis, seen from a mount that is turned and moved", () => {
  const mount = pose([1, 2, 3], [0.5, 0.5, 0.5, 0.5]);
  const kinematics = new Kinematics(irb120(mount), TOOL);
  for (const { deg, place, z } of STATED) {
    const tip = kinematics.tip(deg.map((angle) => (angle * Math.PI) / 180), new Matrix4()).elements;
    const [x, y, height] = place.map((value, i) => value + 0.15 * z[i]!) as [number, number, number];
    near(tip.slice(12, 15), [1 + height, 2 + x, 3 + y]);
  }
});

test("rows of joints give a place each, and what is left over none", () => {
  const kinematics = new Kinematics(irb120(pose([0, 0, 0])), null);
  const rows = [...STATED.flatMap(({ deg }) => deg.map((angle) => (angle * Math.PI) / 180)), 1, 2];
  near(kinematics.places(rows), STATED.flatMap(({ place }) => place));
  assert.equal(kinematics.places(rows).length, 6);
  assert.equal(kinematics.places([]).length, 0);
});

test("the frames of the joints run from the base to the wrist", () => {
  const places: number[][] = [];
  new Kinematics(irb120(pose([0, 0, 0])), TOOL).frames([0, 0, 0, 0, 0, 0], 0, (frame) => places.push(frame.elements.slice(12, 15)));
  const expected = [[0, 0, 0], [0, 0, 0.29], [0, 0, 0.56], [0, 0, 0.63], [0.302, 0, 0.63], [0.374, 0, 0.63]];
  assert.equal(places.length, expected.length);
  places.forEach((place, i) => near(place, expected[i]!));
});

test("a quaternion's length does not matter, and one without length is no turn", () => {
  near(matrixOf(pose([1, 2, 3], [2, 0, 0, 2])).elements, [0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 1, 2, 3, 1]);
  near(matrixOf(pose([1, 2, 3], [0, 0, 0, 0])).elements, [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 1, 2, 3, 1]);
});

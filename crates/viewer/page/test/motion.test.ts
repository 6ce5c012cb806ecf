import assert from "node:assert/strict";
import { test } from "node:test";
import { Matrix4 } from "three";
import { AXES, Kinematics, matrixOf, Motion, newState } from "../src/motion.ts";
import { indexBefore, NumbersError } from "../src/numbers.ts";
import { irb120, pose, TOOL } from "./irb120.ts";

/** Joint j runs along (j + 1)(t³ − 2t) with the knots given, which a cubic meets exactly. */
function cubic(times: number[]): Motion {
  const rows = (f: (t: number) => number): Float64Array =>
    Float64Array.from(times.flatMap((t) => Array.from({ length: AXES }, (_, j) => (j + 1) * f(t))));
  return new Motion(Float64Array.from(times), rows((t) => t ** 3 - 2 * t), rows((t) => 3 * t * t - 2));
}

test("between knots the joints follow the cubic, its speed and its acceleration", () => {
  const motion = cubic([0, 0.3, 1, 2.5]);
  const state = newState();
  for (const t of [0, 0.1, 0.3, 0.99, 1, 2.4999]) {
    motion.at(t, state);
    for (let j = 0; j < AXES; j++) {
      assert.ok(Math.abs(state.q[j]! - (j + 1) * (t ** 3 - 2 * t)) < 1e-12);
      assert.ok(Math.abs(state.qd[j]! - (j + 1) * (3 * t * t - 2)) < 1e-11);
      assert.ok(Math.abs(state.qdd[j]! - (j + 1) * 6 * t) < 1e-10);
    }
  }
});

test("times in any order give the same as in order", () => {
  const [motion, fresh] = [cubic([0, 0.3, 1, 2.5]), cubic([0, 0.3, 1, 2.5])];
  const [a, b] = [newState(), newState()];
  for (const t of [2.4, 0, 1, 0.29, 2.5, 0.3, 0.31]) {
    motion.at(t, a);
    fresh.at(t, b);
    assert.deepEqual(a, b);
  }
});

test("outside its time the arm rests at the nearer end", () => {
  const motion = cubic([0, 1, 2]);
  const state = newState();
  motion.at(-1, state);
  assert.ok(state.q.every((v) => Math.abs(v) < 1e-15) && state.qd.every((v) => v === 0) && state.qdd.every((v) => v === 0));
  motion.at(99, state);
  assert.ok(Math.abs(state.q[0]! - 4) < 1e-12 && state.qd.every((v) => v === 0));
});

test("at a knot the acceleration on the left is that of the piece before it", () => {
  const times = Float64Array.from([0, 1, 2]);
  const q = new Float64Array(3 * AXES);
  const qd = new Float64Array(3 * AXES);
  q.fill(1, AXES, 2 * AXES);
  const motion = new Motion(times, q, qd);
  const state = newState();
  // There and back: q(u) = 3u² − 2u³ has q̈(1) = −6. There and rest: 0 on the right.
  assert.ok(Math.abs(motion.before(1, state).qdd[0]! + 6) < 1e-12);
  q.fill(1, 2 * AXES);
  assert.ok(Math.abs(new Motion(times, q, qd).at(1, state).qdd[0]!) < 1e-12);
  assert.ok(Math.abs(new Motion(times, q, qd).before(1, state).qdd[0]! + 6) < 1e-12);
});

test("a motion of one knot rests, and one without knots or with too few numbers is refused", () => {
  const one = new Motion(Float64Array.of(0), new Float64Array(AXES).fill(0.5), new Float64Array(AXES).fill(9));
  const state = newState();
  one.at(3, state);
  assert.ok(state.q.every((v) => v === 0.5) && state.qd.every((v) => v === 0));
  assert.equal(one.duration, 0);
  assert.throws(() => new Motion(new Float64Array(0), new Float64Array(0), new Float64Array(0)), NumbersError);
  assert.throws(() => new Motion(Float64Array.of(0, 1), new Float64Array(6), new Float64Array(12)), NumbersError);
});

test("the index is that of a plain search, whatever the hint", () => {
  const times = [0, 0.5, 0.5, 2, 3];
  for (const t of [-1, 0, 0.2, 0.5, 1.9, 2, 2.5, 3, 9]) {
    const expected = Math.max(0, times.findLastIndex((knot) => knot <= t));
    for (let hint = 0; hint < 6; hint++) assert.equal(indexBefore(times, times.length, t, hint), expected, `${t} from ${hint}`);
  }
});

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

test("each complete row of joints gives a position", () => {
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

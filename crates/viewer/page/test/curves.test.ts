import assert from "node:assert/strict";
import { test } from "node:test";
import { jointShares, positionShare, recordedTipSpeed, sampleTimes, shares, tipSpeed, valueAt } from "../src/curves.ts";
import { AXES, Motion } from "../src/motion.ts";
import type { Arm, Joint, Pose } from "../src/view.ts";

const HERE: Pose = { position_m: [0, 0, 0], quaternion_wxyz: [1, 0, 0, 0] };
const joint = (more: Partial<Joint> = {}): Joint => ({
  name: "j",
  origin: HERE,
  position_rad: [-1, 3],
  speed_rad_s: 2,
  acceleration_rad_s2: 4,
  ...more,
});

/** Six joints about one axis, the flange 0.5 m from it. */
const ARM: Arm = {
  name: "arm",
  mount: HERE,
  joints: Array.from({ length: AXES }, () => joint()),
  links: [],
  flange: { ...HERE, position_m: [0.5, 0, 0] },
};

/** All joints at constant speed. */
function steady(speed: number, times: number[]): Motion {
  const rows = (f: (t: number) => number): Float64Array => Float64Array.from(times.flatMap((t) => new Array<number>(AXES).fill(f(t))));
  return new Motion(Float64Array.from(times), rows((t) => speed * t), rows(() => speed));
}

test("a joint's share of its range is −1 and 1 at its limits", () => {
  assert.deepEqual([-1, 1, 3, 5].map((q) => positionShare(joint(), q)), [-1, 0, 1, 2]);
});

test("speeds and accelerations are shares of their limits, and without a limit there are none", () => {
  const curves = jointShares(steady(0.5, [0, 1, 2]), ARM.joints);
  assert.ok(curves.speed.curves.every((values) => values.every((value) => Math.abs(value - 0.25) < 1e-12)));
  assert.equal(curves.acceleration?.times.length, 6);
  const without = ARM.joints.map(() => joint({ acceleration_rad_s2: null }));
  assert.equal(jointShares(steady(0.5, [0, 1]), without).acceleration, null);
});

test("at a knot the acceleration shows on both sides", () => {
  const q = new Float64Array(3 * AXES).fill(1, AXES);
  const motion = new Motion(Float64Array.of(0, 1, 2), q, new Float64Array(3 * AXES));
  const { times, curves } = jointShares(motion, ARM.joints).acceleration!;
  assert.deepEqual([...times], [0, 0, 1, 1, 2, 2]);
  assert.deepEqual([...curves[0]!].map((value) => 4 * value), [6, 6, -6, 0, 0, 0]);
});

test("the tip's speed is that of the circle it goes on", () => {
  const expected = 0.5 * AXES * 0.1;
  const { curves: [planned] } = tipSpeed(steady(0.1, [0, 1, 2]), ARM, null);
  assert.ok(planned!.every((value) => Math.abs(value - expected) < 1e-6));
  const times = Float64Array.of(0, 0.01, 0.03);
  const positions = Float64Array.from([...times].flatMap((t) => new Array<number>(AXES).fill(0.1 * t)));
  const { curves: [recorded] } = recordedTipSpeed(times, positions, ARM, null);
  // Chords are shorter than the arc.
  assert.ok(recorded!.every((value) => Math.abs(value - expected) < 1e-5));
});

test("long motions are sampled, short ones have all their knots", () => {
  const motion = steady(1, Array.from({ length: 101 }, (_, k) => k / 10));
  assert.equal(sampleTimes(motion).length, 201);
  assert.equal(sampleTimes(motion, 150), motion.times);
  const few = sampleTimes(motion, 50);
  assert.equal(few.length, 50);
  assert.deepEqual([few[0], few[49]], [0, 10]);
});

test("values between points are interpolated, outside there are none", () => {
  const curves = shares(Float64Array.of(0, 1), Float64Array.from([0, 0, 0, 0, 0, 0, 2, 4, 6, 8, 10, 12]), [1, 2, 3, 4, 5, 6]);
  assert.equal(valueAt(curves, 3, 0.25), 0.5);
  assert.equal(valueAt(curves, 5, 1), 2);
  assert.ok(Number.isNaN(valueAt(curves, 0, -0.1)) && Number.isNaN(valueAt(curves, 0, 1.1)));
  assert.ok(Number.isNaN(valueAt({ times: new Float64Array(0), curves: [new Float64Array(0)] }, 0, 0)));
});

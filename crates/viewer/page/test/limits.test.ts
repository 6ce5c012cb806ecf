import assert from "node:assert/strict";
import { test } from "node:test";
import { grouped, measureWords, shareOf } from "../src/limits.ts";
import type { Check, Measure, RequirementGroup, Status, Unit } from "../src/view.ts";

const check = (requirement: string, group: RequirementGroup, place: number, status: Status = "proved"): Check => ({ requirement, words: requirement, status, detail: "", worst: {}, place: "", why: { sentence: "", group, place, section: "", formulas: [], limit: "" } });
const atMost = (bound: number | null, limit: number, unit: Unit): Measure => ({ bound, seen: null, limit, sense: "at_most", unit });
const atLeast = (bound: number | null, limit: number, unit: Unit): Measure => ({ bound, seen: null, limit, sense: "at_least", unit });

test("requirements come in three groups, each in the order of their places", () => {
  const groups = grouped([check("joint_speed", "Within limits", 9), check("clearance", "Safe", 1), check("tip_speed", "Within limits", 3), check("swept", "Washed", 2), check("pressed", "Washed", 1)]);
  assert.deepEqual(groups.map(({ name, checks }) => [name, checks.map(({ requirement }) => requirement)]), [
    ["Washed", ["pressed", "swept"]],
    ["Safe", ["clearance"]],
    ["Within limits", ["tip_speed", "joint_speed"]],
  ]);
});

test("what is not kept is first, in its group and among the groups", () => {
  const groups = grouped([check("pressed", "Washed", 1), check("tip_speed", "Within limits", 3), check("joint_speed", "Within limits", 9, "violated"), check("clearance", "Safe", 1, "not_proved")]);
  assert.deepEqual(groups.map(({ name }) => name), ["Within limits", "Safe", "Washed"]);
  assert.deepEqual(groups[0]!.checks.map(({ requirement }) => requirement), ["joint_speed", "tip_speed"]);
});

test("a bar shows how much of the limit is taken, and more than all of it beyond", () => {
  assert.equal(shareOf(atMost(0.5, 1, "m/s")), 0.5);
  assert.equal(shareOf(atMost(2, 1, "m/s")), 2);
  assert.equal(shareOf(atLeast(0.02, 0.01, "m")), 0.5);
  assert.equal(shareOf(atLeast(0.005, 0.01, "m")), 2);
  assert.ok(Math.abs(shareOf(atLeast(0.999, 0.995, "1"))! - 0.2) < 1e-9);
  for (const none of [atMost(null, 1, "m"), atMost(1, 0, "m"), atLeast(0.1, 0, "rad"), atLeast(-0.1, 0.1, "m")]) assert.equal(shareOf(none), null);
});

test("a rounded bound is never better than the bound", () => {
  assert.equal(measureWords(atMost(0.9479, 1, "m/s")), "0.95 ≤ 1\u202fm/s");
  assert.equal(measureWords(atLeast(0.0191083, 0.01, "m")), "19.1 ≥ 10\u202fmm");
  assert.equal(measureWords(atLeast(0.99918, 0.995, "1")), "99.91 ≥ 99.5\u202f%");
  assert.equal(measureWords(atMost(5.000006e-6, 2e-4, "m")), "0.0051 ≤ 0.2\u202fmm");
  assert.equal(measureWords(atMost(null, 4, "rad/s^2")), "no bound ≤ 4\u202frad/s²");
  for (let k = 0; k < 2000; k++) {
    const value = 10 ** (-4 + 8 * ((k * 0.6180339887) % 1));
    const [most, least] = [atMost(value, 1, "N"), atLeast(value, 1, "N")].map((one) => Number.parseFloat(measureWords(one)));
    assert.ok(most! >= value * (1 - 1e-6) && least! <= value * (1 + 1e-6), String(value));
    assert.ok(most! <= value * 1.1 + 1e-9 && least! >= value * 0.9, String(value));
  }
});

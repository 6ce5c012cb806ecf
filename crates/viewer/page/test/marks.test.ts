import assert from "node:assert/strict";
import { test } from "node:test";
import { clusters, MARK_PX } from "../src/shell/transport.ts";
import type { Check, Status } from "../src/view.ts";

function check(words: string, time_s: number | null, status: Status = "proved"): Check {
  return { requirement: words, words, status, detail: "", worst: time_s === null ? {} : { time_s }, place: "" };
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

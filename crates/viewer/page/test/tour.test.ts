import assert from "node:assert/strict";
import { test } from "node:test";
import { cardText, cardWords } from "../src/shell/card.ts";
import { canTour, stopsOf } from "../src/shell/tour.ts";
import type { Check, Status, View } from "../src/view.ts";

function check(words: string, status: Status, time_s?: number): Check {
  const measure = { bound: 0.8, seen: null, limit: 1, sense: "at_most", unit: "m/s" } as const;
  return { requirement: words, words, status, measure, detail: "", worst: time_s === undefined ? {} : { time_s }, place: "", why: { sentence: "", group: "Within limits", place: 1, section: "", formulas: [], limit: "" } };
}

function view(checks: Check[], passes: boolean): View {
  const headline = `${passes ? "PROVED" : "NOT PROVED"}: 1 plate in 9 s`;
  const certificate = { passes, headline, hash: "proved", checks, contact: null, rests_on: ["assumed: the arm follows", "assumed: a floor", "limits: from the arm"] };
  const heading = { scenario: "kitchen", seed: 3, hash: "0123456789abcdef0123", process: "wash", dry_run: null, treatment: "washed", robot: "irb120", duration_s: 9 };
  return { version: "9.9", certificate, heading, motion: {} } as unknown as View;
}

test("a tour stops where requirements are worst, in order of time", () => {
  const placed = { ...check("placed", "proved"), worst: { place_m: [0, 0, 0] as [number, number, number] } };
  const stops = stopsOf([placed, check("late", "proved", 7), check("never", "proved"), check("early", "violated", 0)], 9);
  assert.deepEqual(stops.map(({ check: { words }, t }) => [words, t]), [["early", 0], ["late", 7], ["placed", 9]]);
});

test("there is a tour of what is proved and moves only", () => {
  assert.equal(canTour(view([], true)), true);
  assert.equal(canTour({ ...view([], true), certificate: null }), false);
  assert.equal(canTour({ ...view([], true), motion: null }), false);
});

test("a card states verdict, numbers, assumptions and hash", () => {
  const text = cardText(cardWords(view([check("tip speed", "proved", 1)], true)));
  const lines = ["PROVED: 1 plate in 9 s", "- 1\u202frequirement: 1 proved", "- tip speed: 0.8 ≤ 1\u202fm/s", "Assumed: the arm follows; 1 more"];
  assert.deepEqual(text.split("\n").slice(0, 4), lines);
  assert.match(text, /irb120, scenario “kitchen”, seed 3, hash 0123456789abcdef; platewash 9\.9/);
});

test("the card of a plan that fails says so first", () => {
  const { badge, headline, measures } = cardWords(view([check("tip speed", "violated", 1)], false));
  assert.deepEqual([badge, headline, measures[0]], ["Violated", "1 plate in 9 s", "1\u202frequirement: 1 violated"]);
});

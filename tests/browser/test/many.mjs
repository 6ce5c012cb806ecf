/** A hundred plates are still a page. */
import assert from "node:assert/strict";
import { join } from "node:path";
import { test } from "node:test";
import { folder, platewash, spiral } from "../lib/command.mjs";
import { address, open, seek } from "../lib/watched.mjs";

const COUNT = 100;

/** Small plates on an arc before the arm, over each other: so many have no room. */
const centres = Array.from({ length: COUNT }, (_, plate) => {
  const [angle, radius] = [-1.1 + (2.2 * plate) / (COUNT - 1), 0.4 + 0.03 * Math.sin(plate)];
  return [radius * Math.cos(angle), radius * Math.sin(angle)].map((value) => Number(value.toFixed(4)));
});

test("a plan of a hundred plates opens and plays", async (t) => {
  const place = await folder(t);
  const scenario = await spiral(
    place,
    ['on_failure = "fail"', 'on_failure = "report"'],
    ['order = "fastest"', 'order = "given"'],
    ["count = 4\n", `positions_m = ${JSON.stringify(centres)}\n`],
    ['overlap = "fail"', 'overlap = "report"'],
    ["plate_radius_m = 0.145", "plate_radius_m = 0.06"],
    ["turns = 3.5", "turns = 1"],
    ["path_radius_m = 0.12385", "path_radius_m = 0.03885"],
  );
  await platewash(place, ["plan", "--quiet", "--scenario", scenario]);
  await platewash(place, ["view", "out/plan.json", "--save", "page.html", "--quiet"]);
  const { page, quiet } = await open(t, address(join(place, "page.html")));
  const { plates, coverage, duration } = await page.evaluate(() => ({
    plates: window.platewash.view.plates.length,
    coverage: window.platewash.view.coverage.length,
    duration: window.platewash.duration,
  }));
  assert.deepEqual([plates, coverage], [COUNT, COUNT]);
  for (const share of [0, 0.5, 1]) {
    await seek(page, share * duration);
    const tip = await page.evaluate(() => window.platewash.tip());
    assert.ok(tip.every(Number.isFinite), `${tip}`);
  }
  quiet();
});

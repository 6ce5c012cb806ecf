import assert from "node:assert/strict";
import { test } from "node:test";
import { NEVER, OUTSIDE } from "../src/coverage.ts";
import { cleanShare, cleanTimes } from "../src/dirt.ts";
import { NumbersError } from "../src/numbers.ts";
import type { PlateDirt, View } from "../src/view.ts";

function dirt(steps: number[]): PlateDirt {
  const clean = { shape: [2, 3], u16: Buffer.from(Uint16Array.from(steps).buffer).toString("base64") };
  return { plate: 1, half_m: 0.1, dose_pa_m: 25, clean, step_s: 0.5 };
}

/** A view with dirt on plate 1, of which so much is proved clean. */
function view(of: PlateDirt, at_least: number): View {
  const certificate = { contact: { plates: [{ plate: 1, dose: { at_least } }] } };
  return { dirt: [of], certificate } as unknown as View;
}

test("dirt goes at its times, stays where the dose is never proved, and is nowhere beyond the rim", () => {
  assert.deepEqual([...cleanTimes(dirt([OUTSIDE, 4, 0, 2, NEVER, 4]))], [-1, 2, 0, 1, 1e9, 2]);
  assert.throws(() => cleanTimes({ ...dirt([]), clean: { shape: [1], u8: "AA==" } }), NumbersError);
});

test("the clean share grows as dirt goes, and never beyond what is proved", () => {
  const shown = view(dirt([OUTSIDE, 4, 0, 2, NEVER, 4]), 0.7);
  assert.deepEqual([-1, 0, 0.9, 1, 1.9, 2, 1e6].map((t) => cleanShare(shown, 1, t)), [0, 0.2, 0.2, 0.4, 0.4, 0.7, 0.7]);
  assert.equal(cleanShare(shown, 0, 1), null);
});

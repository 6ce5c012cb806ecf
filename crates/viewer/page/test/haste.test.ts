import assert from "node:assert/strict";
import { test } from "node:test";
import { Haste } from "../src/scene/haste.ts";

/** A frame at a time: whether it is drawn, and whether in haste. */
function frame(haste: Haste, now_ms: number, dirty: boolean, held = false): "none" | "hasty" | "full" {
  const owed = haste.owes(now_ms, held);
  const hasty = haste.hasty(now_ms);
  if (!dirty && !owed) return "none";
  haste.drawn(now_ms, hasty);
  return hasty ? "hasty" : "full";
}

test("with a graphics processor every frame has full quality", () => {
  const haste = new Haste(false);
  for (const now of [0, 10, 20]) {
    haste.hurry();
    assert.equal(frame(haste, now, true), "full");
  }
  assert.equal(frame(haste, 1000, false), "none");
});

test("a change after a rest is drawn in full, those that follow it in haste, and then one frame in full", () => {
  const haste = new Haste(true);
  haste.change();
  assert.equal(frame(haste, 1000, true), "full");
  assert.equal(frame(haste, 1016, false), "none");
  haste.change();
  assert.equal(frame(haste, 1100, true), "hasty");
  assert.equal(frame(haste, 1300, false), "none");
  assert.equal(frame(haste, 1350, false), "full");
  assert.equal(frame(haste, 5000, false), "none");
});

test("frames in quick succession have low quality at any speed", () => {
  const haste = new Haste(true);
  const found = [1000, 1600, 2200].map((now) => {
    haste.change();
    return frame(haste, now, true);
  });
  assert.deepEqual(found, ["full", "hasty", "hasty"]);
  assert.equal(frame(haste, 2300, false), "none");
  haste.change();
  assert.equal(frame(haste, 2900, true), "full");
});

test("interactive changes are drawn at once in low quality, others in full", () => {
  const haste = new Haste(true);
  haste.hurry();
  assert.equal(frame(haste, 1000, true), "hasty");
  assert.equal(frame(haste, 1010, true), "full");
  assert.equal(frame(haste, 2000, false), "none");
});

test("during a drag the full frame comes later", () => {
  const haste = new Haste(true);
  haste.hurry();
  assert.equal(frame(haste, 1000, true, true), "hasty");
  assert.equal(frame(haste, 1300, false, true), "none");
  assert.equal(frame(haste, 1600, false, true), "full");
});

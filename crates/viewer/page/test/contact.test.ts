import assert from "node:assert/strict";
import { test } from "node:test";
import { plateGeometry } from "../src/scene/shapes.ts";
import { fixedShort } from "../src/format.ts";
import { contactWords, forceWords } from "../src/shell/requirements.ts";
import { meaning } from "../src/shell/plates.ts";
import type { Coverage } from "../src/coverage.ts";
import type { Contact, Plate, PressedRule, ProvedExtreme, ProvedShare } from "../src/view.ts";
import { pose } from "./irb120.ts";

const share = (at_least: number): ProvedShare => ({ at_least, required: 0.98, threshold: 0 });
const extreme = (bound: number): ProvedExtreme => ({ bound, time_s: 0, place_m: [0, 0, 0] });

const CONTACT: Contact = {
  asked: {
    compression_m: 0.001, height_error_m: 0.0015, share: 0.995, strain: 0.6, force_n: [1, 40], time_s: 0.05, time_share: 0.98, dose_pa_m: 25, dose_share: 0.98,
  },
  plates: [{ plate: 0, pressed: share(1), time: share(0.99), dose: share(0.99), strain: extreme(0.41), least_force_n: extreme(4.06),
    greatest_force_n: extreme(22.01), friction_torque_nm: [0.0912, 0.301], }],
};

test("numbers are as short as they can be", () => {
  assert.deepEqual([1, 1.5, 0.125, 40, 100, 0].map((value) => fixedShort(value, 2)), ["1", "1.5", "0.13", "40", "100", "0"]);
  assert.deepEqual([100, 40].map((value) => fixedShort(value, 0)), ["100", "40"]);
});

test("bounds of a force are rounded outwards, and said to be unknown where they are", () => {
  assert.equal(forceWords(4.06, 22.01), "4.0 – 22.1");
  assert.equal(forceWords(undefined, 3), "? – 3.0");
});

test("a torque is stated only where it is proved of every plate", () => {
  const words = contactWords(CONTACT);
  for (const part of ["±1.5\u202fmm", "pressed by 1\u202fmm", "0.05\u202fs", "25\u202fPa·m", "1 to 40\u202fN", "0.10 to 0.31\u202fN·m", "assumed"]) {
    assert.ok(words.includes(part), `${part}: ${words}`);
  }
  const { friction_torque_nm: _, ...rest } = CONTACT.plates[0]!;
  const unknown = { ...CONTACT, plates: [...CONTACT.plates, rest] };
  assert.ok(!contactWords(unknown).includes("N·m"));
});

test("maps say what they show", () => {
  const of = (...counted: (PressedRule | null)[]): string => meaning(counted.map((one) => ({ counted: one }) as Coverage));
  const promised = { compression_m: 0.001, height_error_m: 0.001, is_promised: true };
  const touched = { compression_m: 0, height_error_m: 0, is_promised: false };
  assert.match(of(promised), /pressed by 1\u202fmm or more, wherever within ±1\u202fmm/);
  assert.match(of(touched, touched), /touches/);
  assert.match(of(touched, null), /was over/);
  assert.match(of(), /was over/);
});

/** Least height of a plate's triangles at a distance from its axis, and the least of all. */
function lowest(plate: Plate, radius: number): [number, number] {
  const place = plateGeometry(plate, 32).getAttribute("position");
  let [there, all] = [Infinity, Infinity];
  for (let i = 0; i < place.count; i++) {
    all = Math.min(all, place.getZ(i));
    if (Math.abs(Math.hypot(place.getX(i), place.getY(i)) - radius) < 1e-6) there = Math.min(there, place.getZ(i));
  }
  return [there, all];
}

test("a foot stands below the body under the pole, and its side ends at the body", () => {
  const plate: Plate = { name: "plate", pose: pose([0, 0, 0]), surface: { meridian: "disc", radius_m: 0.1 }, meridian_m: [[0, 0], [0.06, 0], [0.1, 0.02]], thickness_m: 0.005, foot: { radius_m: 0.05, height_m: 0.004 } };
  const [there, all] = lowest(plate, 0.05);
  assert.ok(Math.abs(all + 0.009) < 1e-7 && there === all, `${there} ${all}`);
  const { foot: _, ...bare } = plate;
  const [, without] = lowest(bare, 0.05);
  assert.ok(Math.abs(without + 0.005) < 1e-7);
  for (const foot of [{ radius_m: Number.NaN, height_m: 1 }, { radius_m: 0.05, height_m: -1 }, { radius_m: 0, height_m: 0.1 }]) {
    assert.ok(Math.abs(lowest({ ...plate, foot }, 0.05)[1] + 0.005) < 1e-7);
  }
  assert.ok(Math.abs(lowest({ ...plate, foot: { radius_m: 0.2, height_m: 0.004 } }, 0.2)[1] + 0.009) < 1e-7);
});

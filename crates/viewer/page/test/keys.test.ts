import assert from "node:assert/strict";
import { test } from "node:test";
import { distance, readNumber, readValue, stepped, suggestions, valueText } from "../src/edit/domain.ts";
import { roomFor, shifted, turned } from "../src/edit/placing.ts";
import type { FormDomain } from "../src/edit/protocol.ts";

const read = (domain: FormDomain, text: string): unknown => {
  const found = readValue({ domain }, text);
  return "value" in found ? found.value : "wrong";
};

test("numbers as people type them, and nothing else", () => {
  const good: [string, number][] = [["1", 1], [" -0.5 ", -0.5], ["1e-6", 1e-6], [".5", 0.5], ["5.", 5], ["\u22123", -3], ["0,25", 0.25], ["1_000", 1000]];
  for (const [text, value] of good) assert.equal(readNumber(text), value, text);
  for (const text of ["", ".", "-", "e5", "1e999", "NaN", "Infinity", "inf", "0x10", "1 2", "1,2,3", "--1", "1e1e1"]) assert.equal(readNumber(text), null, text);
});

test("values out of their domain are invalid", () => {
  const closed: FormDomain = { kind: "number", least: 0, most: 2 };
  assert.deepEqual(["0", "2", "2.1", "-0.1", "x", ""].map((text) => read(closed, text)), [0, 2, "wrong", "wrong", "wrong", "wrong"]);
  assert.deepEqual(["0", "1e-9"].map((text) => read({ kind: "number_above", least: 0, most: 2 }, text)), ["wrong", 1e-9]);
  assert.deepEqual(["3", "3.5", "1e300"].map((text) => read({ kind: "integer", least: 1, most: Number.MAX_VALUE }, text)), [3, "wrong", "wrong"]);
  assert.deepEqual(["pd", "PD", ""].map((text) => read({ kind: "word", words: ["pd", "exact"] }, text)), ["pd", "wrong", "wrong"]);
  assert.deepEqual(["true", "1"].map((text) => read({ kind: "bool" }, text)), [true, "wrong"]);
  assert.deepEqual(["a b", "a\u0007", "<b>"].map((text) => read({ kind: "text" }, text)), ["a b", "wrong", "<b>"]);
  assert.deepEqual(["0, 1", "1, 0", "0", "0 1 2"].map((text) => read({ kind: "range", least: -1, most: 1 }, text)), [[0, 1], "wrong", "wrong", "wrong"]);
  assert.deepEqual(read({ kind: "joints", least: -9, most: 9 }, "[1, 2, 3, 4, 5, 6]"), [1, 2, 3, 4, 5, 6]);
  assert.equal(read({ kind: "joints_above", least: 0, most: 9 }, "1 2 3 4 5 0"), "wrong");
  assert.deepEqual(read({ kind: "points", least: -10, most: 10 }, "0.1, 0\n[0.2, -0.3]"), [[0.1, 0], [0.2, -0.3]]);
  for (const text of ["", "1", "1, 2, 3", "1, 11", "1, NaN", "1e999, 0"]) assert.equal(read({ kind: "points", least: -10, most: 10 }, text), "wrong", text);
});

test("positions of joints are names with a number each", () => {
  const domain: FormDomain = { kind: "positions", least: -1000, most: 1000 };
  assert.deepEqual(read(domain, "rail = 0.3, tip/finger=-2e-3"), { rail: 0.3, "tip/finger": -0.002 });
  assert.deepEqual(read(domain, ""), {});
  for (const text of ["rail", "= 1", "rail = ", "rail = x", "rail = 1001", "rail = 1, rail = 2", "a\u0007 = 1"]) assert.equal(read(domain, text), "wrong", text);
  assert.equal(valueText({ rail: 0.3, finger: -0.002 }), "rail = 0.3, finger = -0.002");
});

test("values are shown as they are read", () => {
  for (const value of [0.1 + 0.2, 1e-12, -0.0001, 5e-324, 123456789.123]) assert.equal(readNumber(valueText(value)), value);
  assert.equal(valueText([[0.1, 2], [3, 4]]), "[0.1, 2], [3, 4]");
});

test("a step is one of the last digit, within the domain, without noise", () => {
  const domain = { kind: "number", least: 0, most: 2 } as const;
  assert.deepEqual([stepped("0.29", 1, false, domain), stepped("0.3", 1, false, domain), stepped("0.25", -1, true, domain)], ["0.30", "0.4", "0.15"]);
  assert.deepEqual([stepped("0", -1, false, domain), stepped("x", 1, false, domain)], [null, null]);
  assert.equal(stepped("55", 1, false, { kind: "integer", least: 2, most: 100 }), "56");
});

test("misspelled words get the nearest word as a hint", () => {
  assert.deepEqual([distance("", "abc"), distance("tunrs", "turns"), distance("kitten", "sitting"), distance("a", "a")], [3, 1, 3, 0]);
  const keys = ["wash.turns", "wash.tilt_max_deg", "tool.length_m", "layout.plate_radius_m", "job.order"];
  assert.equal(suggestions("trns", keys)[0], "wash.turns");
  assert.equal(suggestions("wash.trun", keys)[0], "wash.turns");
  assert.equal(suggestions("lenght", keys)[0], "tool.length_m");
  assert.deepEqual(suggestions("zzzzzzzz", keys), []);
  assert.deepEqual(suggestions("", keys), []);
  assert.ok(suggestions("x".repeat(100_000), keys).length === 0);
});

test("plates are shifted and turned, the others stay exactly where they are", () => {
  const centres: [number, number][] = [[0.1, 0.2], [0.123456789, -1 / 3]];
  const moved = shifted(centres, [0], 0.005, -0.05);
  assert.deepEqual(moved, [[0.105, 0.15], [0.123456789, -1 / 3]]);
  let round = centres;
  for (let k = 0; k < 360; k++) round = turned(round, [0], [0, 0], Math.PI / 180);
  assert.equal(round[1], centres[1]);
  assert.ok(Math.hypot(round[0]![0] - 0.1, round[0]![1] - 0.2) < 0.002);
  assert.deepEqual(turned([[1, 0]], [0], [0, 0], Math.PI / 2), [[0, 1]]);
});

test("a new plate is placed where there is room", () => {
  const centres: [number, number][] = [];
  for (let k = 0; k < 30; k++) {
    const room = roomFor(centres, 0.145, [0, 0], 0.29);
    for (const one of centres) assert.ok(Math.hypot(one[0] - room[0], one[1] - room[1]) > 0.29, `${k}`);
    assert.ok(Math.hypot(...room) > 0.29);
    centres.push(room);
  }
});

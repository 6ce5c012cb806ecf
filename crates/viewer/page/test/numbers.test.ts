import assert from "node:assert/strict";
import { test } from "node:test";
import { decode, floats, NumbersError } from "../src/numbers.ts";
import type { Numbers } from "../src/view.ts";

const base64 = (bytes: number[]): string => Buffer.from(bytes).toString("base64");

test("every kind is little-endian", () => {
  const one = Buffer.alloc(8);
  one.writeDoubleLE(-0.1);
  assert.deepEqual([...decode({ shape: [1], f64: one.toString("base64") })], [-0.1]);
  const half = Buffer.alloc(4);
  half.writeFloatLE(0.5);
  assert.deepEqual([...decode({ shape: [1], f32: half.toString("base64") })], [0.5]);
  assert.deepEqual([...decode({ shape: [2], u16: base64([255, 255, 254, 0]) })], [65535, 254]);
  assert.deepEqual([...decode({ shape: [1, 3], u8: base64([7, 0, 255]) })], [7, 0, 255]);
});

test("an empty array is one", () => {
  assert.equal(decode({ shape: [0, 6], f64: "" }).length, 0);
});

test("numbers of any kind come in double precision", () => {
  const read = floats({ shape: [2], u8: base64([3, 4]) });
  assert.ok(read instanceof Float64Array);
  assert.deepEqual([...read], [3, 4]);
});

test("what is no array of its shape is refused", () => {
  const bad: Numbers[] = [
    { shape: [2], f64: base64([1, 2, 3]) },
    { shape: [1], f64: "" },
    { shape: [1], u8: "%%%" },
    { shape: [1] } as unknown as Numbers,
  ];
  for (const numbers of bad) assert.throws(() => decode(numbers), NumbersError);
});

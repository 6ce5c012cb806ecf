import assert from "node:assert/strict";
import { test } from "node:test";
import { BEHIND_S, Clock, Follower, stepSpeed } from "../src/clock.ts";

test("a film plays as its clock does, without error however many frames there are", () => {
  const clock = new Clock(1000);
  clock.play(50);
  for (let frame = 1; frame <= 30_000; frame++) clock.tick(50 + frame * 16.7);
  assert.ok(Math.abs(clock.time - 501) < 1e-9);
});

test("speed counts from where it is changed", () => {
  const clock = new Clock(100);
  clock.play(0);
  clock.tick(1000);
  clock.setSpeed(10, 1000);
  clock.tick(1500);
  assert.equal(clock.time, 6);
  clock.setSpeed(0.1, 1500);
  clock.tick(2500);
  assert.ok(Math.abs(clock.time - 6.1) < 1e-12);
});

test("a frame that is stamped before the start, or a clock that runs backwards, holds the film", () => {
  const clock = new Clock(10);
  clock.seek(3, 100);
  clock.play(100);
  assert.equal(clock.tick(92), false);
  assert.equal(clock.time, 3);
  clock.tick(1100);
  clock.tick(600);
  assert.equal(clock.time, 4);
});

test("a film stops at its end and restarts from the beginning", () => {
  const clock = new Clock(2);
  clock.play(0);
  assert.equal(clock.tick(5000), true);
  assert.equal(clock.time, 2);
  assert.equal(clock.playing, false);
  clock.play(6000);
  assert.equal(clock.time, 0);
  clock.tick(6500);
  assert.equal(clock.time, 0.5);
});

test("jumps stay within the film and NaN changes nothing", () => {
  const clock = new Clock(2);
  for (const [to, expected] of [[1, 1], [-5, 0], [99, 2], [Number.NaN, 2], [Number.POSITIVE_INFINITY, 2]] as const) {
    clock.seek(to, 0);
    assert.equal(clock.time, expected);
  }
  for (const [speed, expected] of [[99, 10], [0, 0.1], [-3, 0.1], [2, 2], [Number.NaN, 2]] as const) {
    clock.setSpeed(speed, 0);
    assert.equal(clock.speed, expected);
  }
});

test("a film without length cannot be played", () => {
  const clock = new Clock(0);
  clock.play(0);
  assert.equal(clock.playing, false);
});

test("a hidden page continues where it stopped", () => {
  const clock = new Clock(100);
  clock.play(0);
  clock.tick(1000);
  clock.resume(60_000);
  clock.tick(61_000);
  assert.equal(clock.time, 2);
});

test("speeds step through the list from anywhere and end at its ends", () => {
  assert.deepEqual([1, 1.3, 10, 0.1].map((speed) => stepSpeed(speed, true)), [2, 2, 10, 0.25]);
  assert.deepEqual([1, 1.3, 10, 0.1].map((speed) => stepSpeed(speed, false)), [0.5, 1, 5, 0.1]);
});

test("a live run is followed evenly, a moment behind, though samples come in bursts", () => {
  const follower = new Follower();
  let before = 0;
  for (let ms = 0; ms <= 20_000; ms += 16) {
    const arrived = Math.floor(ms / 100) / 10;
    const time = follower.tick(ms, arrived);
    assert.ok(time >= before && time <= arrived);
    if (ms > 3000) assert.ok(Math.abs(time - (ms / 1000 - BEHIND_S)) < 0.2, `${time} at ${ms}`);
    if (ms > 3000) assert.ok(time - before < 0.016 * 1.6);
    before = time;
  }
});

test("after a lost connection a live run is caught up with at once", () => {
  const follower = new Follower();
  follower.tick(0, 1);
  assert.equal(follower.tick(16, 20), 20 - BEHIND_S);
});

/** Playing keeps time. */
import assert from "node:assert/strict";
import { test } from "node:test";
import { shipped } from "../lib/command.mjs";
import { address, open } from "../lib/watched.mjs";

test("under a clock that is handed in, playing is exact", async (t) => {
  const { page, quiet } = await open(t, address(await shipped()));
  const found = await page.evaluate(() => {
    const film = window.platewash;
    let now = 1000;
    film.setClock(() => now);
    film.pause();
    film.seek(1);
    const times = [film.time()];
    const pass = (milliseconds) => {
      now += milliseconds;
      film.step();
      times.push(film.time());
    };
    pass(500); // It does not play yet.
    film.play();
    pass(250);
    pass(16.625);
    film.setSpeed(2);
    pass(1000);
    film.setSpeed(0.1);
    pass(500);
    pass(-400); // A clock that runs backwards holds it.
    film.pause();
    pass(500);
    film.seek(film.duration - 0.125);
    film.setSpeed(1);
    film.play();
    pass(60_000);
    times.push(film.isPlaying() ? 1 : 0);
    return { times, duration: film.duration };
  });
  const wanted = [1, 1, 1.25, 1.266625, 3.266625, 3.316625, 3.316625, 3.316625, found.duration, 0];
  assert.equal(found.times.length, wanted.length);
  found.times.forEach((time, index) => assert.ok(Math.abs(time - wanted[index]) < 1e-9, `${index}: ${found.times}`));
  quiet();
});

test("in real time, four seconds are four seconds", async (t) => {
  const { page, quiet } = await open(t, address(await shipped()), { size: { width: 400, height: 300 } });
  const { duration, shown, passed } = await page.evaluate(async () => {
    const film = window.platewash;
    film.setClock(null);
    film.setSpeed(1);
    film.seek(0);
    film.play();
    const start = performance.now();
    await new Promise((resolve) => setTimeout(resolve, 4000));
    film.step();
    return { duration: film.duration, shown: film.time(), passed: (performance.now() - start) / 1000 };
  });
  assert.ok(duration > 1.2 * passed, `the film ends after ${duration} s, before ${passed} s have passed`);
  assert.ok(Math.abs(shown - passed) < 0.1 * passed, `${shown} s are shown after ${passed} s`);
  quiet();
});

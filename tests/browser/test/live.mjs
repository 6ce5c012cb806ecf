/** A live run is shown as it runs, over a connection that drops. */
import assert from "node:assert/strict";
import { createServer, connect } from "node:net";
import { join } from "node:path";
import { test } from "node:test";
import { folder, rows, serve } from "../lib/command.mjs";
import { open, seek, text } from "../lib/watched.mjs";

/** Between two samples of 50 Hz the page goes straight on. */
const TOLERANCE_M = 2e-3;

/** Hands on what comes to a server that wants to be called by its own name; `up(false)` cuts all connections and takes no new ones. */
async function proxy(test, url) {
  const { hostname, port } = new URL(url);
  const sockets = new Set();
  let isUp = true;
  const server = createServer((near) => {
    if (!isUp) {
      near.destroy();
      return;
    }
    const far = connect(Number(port), hostname);
    const own = `${hostname}:${server.address().port}`;
    for (const [socket, other] of [[near, far], [far, near]]) {
      sockets.add(socket);
      socket.on("error", () => {});
      socket.on("close", () => {
        sockets.delete(socket);
        other.destroy();
      });
    }
    near.on("data", (chunk) => far.write(Buffer.from(chunk.toString("latin1").replaceAll(own, `${hostname}:${port}`), "latin1")));
    far.on("data", (chunk) => near.write(chunk));
  });
  await new Promise((resolve) => server.listen(0, hostname, resolve));
  const up = (wanted) => {
    isUp = wanted;
    if (!isUp) for (const socket of sockets) socket.destroy();
  };
  test.after(() => {
    up(false);
    server.close();
  });
  return { url: `http://${hostname}:${server.address().port}/`, up };
}

/** Waits for a state of the page, or for a time that it shows [s]. */
const until = (page, state, t) =>
  page.waitForFunction(
    ([state, t]) => window.platewash.state === state && window.platewash.time() >= t,
    [state, t],
    { polling: 50 },
  );

const now = (page) => page.evaluate(() => [window.platewash.time(), performance.now() / 1000]);

test("a live run is shown while it runs, and what was missed when its connection dropped", async (t) => {
  const place = await folder(t);
  // Four plates take half a minute: a browser on a busy machine may need many seconds to connect again, and the run must not be over then.
  const live = await serve(t, place, ["run", "--scenario", "kitchen", "--live", "--no-open", "--port", "0"]);
  const between = await proxy(t, live.url);
  const { page } = await open(t, between.url, { size: { width: 400, height: 300 } });

  await until(page, "running", 0.5);
  const [first, began] = await now(page);
  await until(page, "running", first + 6);
  const [second, ended] = await now(page);
  const pace = (second - first) / (ended - began);
  assert.ok(pace > 0.6 && pace < 1.7, `it runs at ${pace} times real time`);
  assert.match(await text(page), /live/i);
  assert.equal(await page.locator("select.follow option:checked").innerText(), "Live motion");
  for (const [width, height] of [[1440, 900], [1280, 800], [820, 1180], [390, 844]]) {
    await page.setViewportSize({ width, height });
    const covered = await page.evaluate(() => {
      const box = (element) => element.getBoundingClientRect();
      const pill = box(document.querySelector(".banner"));
      return [...document.querySelectorAll(".toolbar > *")].filter((tool) => {
        const { left, right, top, bottom } = box(tool);
        return left < pill.right && pill.left < right && top < pill.bottom && pill.top < bottom;
      }).map((tool) => tool.textContent);
    });
    assert.deepEqual(covered, [], `the pill covers tools at ${width}`);
  }
  await page.setViewportSize({ width: 400, height: 300 });

  between.up(false);
  await until(page, "reconnecting", 0);
  const [lost] = await now(page);
  await page.waitForTimeout(1500);
  between.up(true);
  await until(page, "running", lost + 2);
  await until(page, "done", 0);
  assert.equal(await live.ended, 0, live.said());

  await page.evaluate(() => window.platewash.follow("executed"));
  const executed = await rows(join(place, "out", "executed.csv"));
  for (const after of [-1, 0.4, 0.8, 1.2]) {
    const row = executed.find(({ t_s }) => Number(t_s) >= lost + after);
    await seek(page, Number(row.t_s));
    const tip = await page.evaluate(() => window.platewash.tip());
    const apart = Math.hypot(...[row.tip_x_m, row.tip_y_m, row.tip_z_m].map((value, axis) => Number(value) - tip[axis]));
    assert.ok(apart < TOLERANCE_M, `at ${row.t_s} s, ${after} s after the connection was lost: ${1000 * apart} mm apart`);
  }
});

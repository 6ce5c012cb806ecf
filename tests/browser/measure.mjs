/**
 * Times of the page, as medians: the first frame of a recorded page, and from the drop of a plate to its drawn plan and proof in a live
 * cell. `cargo xtask measure` sets the environment: node measure.mjs [DRAGS].
 */
import { unpack } from "./lib/browser.mjs";
import { centres, drag, FACE_M, onScreen, settled } from "./lib/cell.mjs";
import { folder, page, serve } from "./lib/command.mjs";
import { open } from "./lib/watched.mjs";

const SIZE = { width: 1280, height: 800 };
/** So coarse that there is hardly a pixel to draw: near to a machine with a graphics processor. */
const COARSE = 0.1;
const drags = Number(process.argv[2] ?? 50);
const ends = [];
const life = { after: (end) => ends.push(end) };

const median = (values) => values.toSorted((a, b) => a - b)[values.length >> 1];
const medians = (rows) => Object.fromEntries(Object.keys(rows[0]).map((name) => [name, median(rows.map((row) => row[name] ?? 0))]));
const print = (title, row) => {
  process.stdout.write(`${title}\n`);
  for (const [name, value] of Object.entries(row)) process.stdout.write(`    ${name.padEnd(28)} ${value.toFixed(1).padStart(8)}\n`);
};

/** Time from navigation to the first frame, each time in a page of its own [ms]. */
async function firstFrames(url, count, deviceScaleFactor) {
  const rows = [];
  for (let k = 0; k < count; k++) {
    const { page: opened } = await open(life, url, { size: SIZE, deviceScaleFactor });
    rows.push(
      await opened.evaluate(() => {
        const [navigation] = performance.getEntriesByType("navigation");
        return { "document read": navigation.domInteractive, "first frame": window.platewash.frame.first_ms };
      }),
    );
    await opened.context().close();
  }
  return medians(rows);
}

/** Drags one plate about the place where it lies: when each step was done, from the drop as the browser stamps it [ms]. */
async function drops(opened, count) {
  await opened.evaluate(() => addEventListener("pointerup", (event) => (window.dropped = event.timeStamp), { capture: true }));
  const hand = await opened.context().newCDPSession(opened);
  const plate = 1;
  const [x, y] = (await centres(opened))[plate];
  const rows = [];
  for (let k = 0; k < count; k++) {
    // By the golden angle round a circle, so that no two drags are alike and each is long enough.
    const turn = 2.4 * k;
    const to = [x - 0.03 + 0.03 * Math.cos(turn), y + 0.02 + 0.03 * Math.sin(turn)];
    await drag(opened, plate, to, { steps: 6, release: false });
    // Let go a little farther on, as by a hand: nothing about this place was asked before.
    const [left, top] = await onScreen(opened, [to[0] - 0.008, to[1] - 0.008, FACE_M]);
    await hand.send("Input.dispatchMouseEvent", { type: "mouseReleased", x: left, y: top, button: "left", clickCount: 1 });
    await opened.mouse.up();
    await opened.waitForFunction(() => !document.documentElement.hasAttribute("data-dragging"));
    await settled(opened);
    rows.push(
      await opened.evaluate(() => {
        const last = window.platewash.edit.timings().findLast(({ want }) => want === "proof");
        // Where there is no plan there is nothing to measure.
        if (last.drawnProof === null) return null;
        const since = (time) => time - Math.max(last.asked, window.dropped);
        const steps = Object.entries(last.ms).map(([name, ms]) => [`server: ${name}`, ms]);
        return {
          "scenario here": since(last.scenario), "plan here": since(last.plan), "plan drawn": since(last.drawnPlan),
          "proof here": since(last.proof), "proof drawn": since(last.drawnProof), "a drawing call": window.platewash.frame.draw_ms, ...Object.fromEntries(steps),
        };
      }),
    );
  }
  return medians(rows.filter((row) => row !== null));
}

try {
  await unpack();
  const file = await page(await folder(life));
  for (const factor of [1, COARSE]) print(`kitchen's page, ${factor} pixels a CSS pixel, from navigation [ms]`, await firstFrames(`file://${file}`, 9, factor));
  const server = await serve(life, await folder(life), ["edit", "--no-open"]);
  for (const deviceScaleFactor of [1, COARSE]) {
    const { page: opened } = await open(life, server.url, { size: SIZE, deviceScaleFactor });
    await settled(opened);
    print(`${drags} drags of a plate of kitchen, ${deviceScaleFactor} pixels a CSS pixel, from the drop [ms]`, await drops(opened, drags));
    await opened.context().close();
  }
} finally {
  for (const end of ends.reverse()) await end();
}
process.exit();

/**
 * Times of the page, as medians: the first frame of a recorded page, and from the drop of a plate to its drawn plan and proof in a live
 * cell. `cargo xtask measure` sets the environment: node measure.mjs [DRAGS].
 */
import { unpack } from "./lib/browser.mjs";
import { centres, drag, settled } from "./lib/cell.mjs";
import { folder, page, serve } from "./lib/command.mjs";
import { open } from "./lib/watched.mjs";

const SIZE = { width: 1280, height: 800 };
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
async function firstFrames(url, count) {
  const rows = [];
  for (let k = 0; k < count; k++) {
    const { page: opened } = await open(life, url, { size: SIZE });
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

/** Drags one plate about the place where it lies: what each step from the drop to the drawn proof took [ms]. */
async function drops(opened, count) {
  await opened.evaluate(() => addEventListener("pointerup", () => (window.dropped = performance.now()), { capture: true }));
  const plate = 1;
  const [x, y] = (await centres(opened))[plate];
  const rows = [];
  for (let k = 0; k < count; k++) {
    const turn = (2 * Math.PI * k) / count;
    await drag(opened, plate, [x - 0.02 + 0.015 * Math.cos(turn), y + 0.01 + 0.015 * Math.sin(turn)]);
    await settled(opened);
    rows.push(
      await opened.evaluate(() => {
        const last = window.platewash.edit.timings().findLast(({ want, drawnProof }) => want === "proof" && drawnProof !== null);
        const since = (time) => time - window.dropped;
        const steps = Object.entries(last.ms).map(([name, ms]) => [`server: ${name}`, ms]);
        return {
          asked: since(last.asked), "scenario here": since(last.scenario), "plan here": since(last.plan), "plan drawn": since(last.drawnPlan),
          "proof here": since(last.proof), "proof drawn": since(last.drawnProof), "a drawing call": window.platewash.frame.draw_ms, ...Object.fromEntries(steps),
        };
      }),
    );
  }
  return medians(rows);
}

try {
  await unpack();
  const file = await page(await folder(life));
  print("kitchen's page, from navigation [ms]", await firstFrames(`file://${file}`, 9));
  const server = await serve(life, await folder(life), ["edit", "--no-open"]);
  const { page: opened } = await open(life, server.url, { size: SIZE });
  await settled(opened);
  print(`${drags} drags of a plate of kitchen, from the drop [ms]`, await drops(opened, drags));
} finally {
  for (const end of ends.reverse()) await end();
}
process.exit();

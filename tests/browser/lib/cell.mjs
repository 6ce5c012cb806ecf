/** A live cell in the hands of a person: its page, its plates, its verdicts. */
import { open } from "./watched.mjs";
import { serve } from "./command.mjs";

/** Large enough for scene and panels beside each other. */
const SIZE = { width: 1000, height: 640 };

/** Serves a scenario for editing and opens its page. */
export async function edit(test, place, words = [], { size = SIZE } = {}) {
  const server = await serve(test, place, ["edit", "--no-open", ...words]);
  const opened = await open(test, server.url, { size });
  await settled(opened.page);
  return { server, ...opened };
}

/** Waits until nothing is asked any more and all answers are drawn, also where they changed the room that the scene has. */
export const settled = (page) =>
  page.evaluate(async () => {
    await window.platewash.edit.settled();
    // The scene is fitted after the frame that shows the answers, and drawn in the next.
    await new Promise((drawn) => requestAnimationFrame(() => requestAnimationFrame(drawn)));
  });

/** What the page says of the cell. */
export const verdict = (page) => page.evaluate(() => window.platewash.edit.verdict());

export const scenario = (page) => page.evaluate(() => window.platewash.edit.text());

export const centres = (page) => page.evaluate(() => window.platewash.edit.centres());

/** Changes keys as the form does. */
export async function change(page, edits) {
  await page.evaluate((edits) => window.platewash.edit.change(edits), edits);
  await settled(page);
}

/** Where a place of the world is in the window [CSS px]. */
export async function onScreen(page, place_m) {
  const at = await page.evaluate((place) => {
    const canvas = document.querySelector("canvas.scene").getBoundingClientRect();
    const [x, y] = window.platewash.project(place);
    return [canvas.x + x, canvas.y + y];
  }, place_m);
  if (at === null) throw new Error(`${place_m} is not in sight`);
  return at;
}

/** Height of the plates' faces in the shipped scenarios [m]. */
export const FACE_M = 0.03;

/** Drags a plate with the mouse, by its middle or from `grip` [m] beside it. */
export async function drag(page, plate, to_m, { steps = 8, grip = [0, 0], release = true } = {}) {
  const from = (await centres(page))[plate];
  const place = ([x, y]) => [x + grip[0], y + grip[1], FACE_M];
  const [x0, y0] = await onScreen(page, place(from));
  await page.mouse.move(x0, y0);
  await page.mouse.down();
  for (let step = 1; step <= steps; step++) {
    const share = step / steps;
    const on = [0, 1].map((k) => from[k] + share * (to_m[k] - from[k]));
    const [x, y] = await onScreen(page, place(on));
    await page.mouse.move(x, y);
  }
  if (release) await page.mouse.up();
}

/** Cells with plates in sections of their own, and with obstacles: what hands move there, and where the text has it. */
import assert from "node:assert/strict";
import { test } from "node:test";
import { centres, edit, onScreen, scenario, settled, verdict } from "../lib/cell.mjs";
import { folder } from "../lib/command.mjs";
import { text } from "../lib/watched.mjs";

/** Drags from place to place of the world, at one height; `there` is done before the button is let go, told where the place was. */
async function dragged(page, from_m, to_m, there = async () => {}) {
  const [[x0, y0], [x1, y1]] = [await onScreen(page, from_m), await onScreen(page, to_m)];
  await page.mouse.move(x0, y0);
  await page.mouse.down();
  const held = await onScreen(page, from_m);
  for (let step = 1; step <= 8; step++) await page.mouse.move(x0 + ((x1 - x0) * step) / 8, y0 + ((y1 - y0) * step) / 8);
  await there(held);
  await page.mouse.up();
  await settled(page);
}

/** Lines that differ, of two texts of as many lines. */
function changedLines(before, after) {
  const [a, b] = [before.split("\n"), after.split("\n")];
  assert.equal(a.length, b.length);
  return b.filter((line, k) => line !== a[k]);
}

const placeOf = (page, obstacle) =>
  page.evaluate((name) => window.platewash.view.surroundings.obstacles.find((one) => one.name === name).pose.position_m, obstacle);

test("a plate with a section is moved by its section, its holder with it, and undoing gives the text back", async (t) => {
  const { page, quiet } = await edit(t, await folder(t), ["--scenario", "rack"]);
  const [before, at] = [await scenario(page), (await centres(page))[2]];
  const height = await page.evaluate(() => window.platewash.view.plates[2].pose.position_m[2]);
  await dragged(page, [...at, height], [at[0] + 0.02, at[1] + 0.03, height]);
  const [line, holder, ...more] = changedLines(before, await scenario(page));
  assert.deepEqual(more, []);
  const moved = (await centres(page))[2];
  const post = holder.match(/^at_m = \[([^,]+), ([^,]+), 0\.16\]/).slice(1).map(Number);
  assert.ok(Math.hypot(post[0] - 0.49 - moved[0] + at[0], post[1] - moved[1] + at[1]) < 1e-6, holder);
  assert.equal(line, `at_m = [${moved[0]}, ${moved[1]}, ${height}]`);
  assert.ok(Math.hypot(moved[0] - at[0] - 0.02, moved[1] - at[1] - 0.03) < 0.015, `${moved}`);
  await page.getByRole("button", { name: "Add plate" }).click();
  assert.match(await text(page), /add or remove one in the text/);
  await page.evaluate(() => window.platewash.edit.undo());
  await settled(page);
  assert.equal(await scenario(page), before);
  quiet();
});

test("a button adds an obstacle, and undoing takes it away", async (t) => {
  const { page, quiet } = await edit(t, await folder(t), ["--scenario", "kitchen"]);
  const before = await scenario(page);
  await page.getByRole("button", { name: "Add obstacle" }).click();
  await settled(page);
  assert.equal((await verdict(page)).kind, "proved");
  assert.match(await scenario(page), /\[\[obstacle\]\]\nname = "box 1"\nshape = "box"/);
  const [x, y, z] = await placeOf(page, "box 1");
  assert.ok(Math.abs(z - 0.1) < 2e-3, "it stands on the floor");
  for (const [px, py] of await centres(page)) assert.ok(Math.hypot(px - x, py - y) > 0.145 + 0.04);
  // With the keys it comes behind the plates.
  await page.locator("canvas.scene").focus();
  for (let k = 0; k < 5; k++) await page.keyboard.press("n");
  await page.keyboard.press("ArrowRight");
  await settled(page);
  const [to_x, to_y] = await placeOf(page, "box 1");
  assert.ok(Math.abs(Math.hypot(to_x - x, to_y - y) - 0.005) < 1e-6);
  await page.evaluate(() => window.platewash.edit.undo());
  await page.evaluate(() => window.platewash.edit.undo());
  await settled(page);
  assert.equal(await scenario(page), before);
  quiet();
});

test("all tabs fit beside the scene, and every plate lies between toolbar and readout", async (t) => {
  const { page } = await edit(t, await folder(t), ["--scenario", "rack"], { size: { width: 1280, height: 800 } });
  const tabs = await page.locator(".tabs").evaluate(({ scrollWidth, clientWidth }) => ({ scrollWidth, clientWidth }));
  assert.ok(tabs.scrollWidth <= tabs.clientWidth, JSON.stringify(tabs));
  await page.waitForFunction(() => {
    const box = (of) => document.querySelector(of).getBoundingClientRect();
    const [{ bottom: top }, { top: bottom }, { y }] = [box(".toolbar"), box(".readout"), box("canvas.scene")];
    const places = window.platewash.view.plates.map(({ pose }) => window.platewash.project(pose.position_m));
    return places.length === 3 && places.every((at) => at !== null && y + at[1] > top && y + at[1] < bottom);
  });
  await page.setViewportSize({ width: 390, height: 844 });
  await page.waitForFunction(() => document.querySelector("canvas.scene").clientHeight >= 844 / 2 - 1);
});

test("an obstacle is added, moved and removed with the keyboard alone, in sight of who does it", async (t) => {
  const { page, quiet } = await edit(t, await folder(t));
  const first = await scenario(page);
  await page.getByRole("button", { name: "Add obstacle" }).focus();
  await page.keyboard.press("Enter");
  await settled(page);
  const row = page.getByRole("group", { name: "box 1", exact: true });
  assert.ok(await row.evaluate((element) => element === document.activeElement), "the focus is not on what was added");
  const at = await placeOf(page, "box 1");
  // Nearer to the eye than the arm, and on the canvas.
  const [[, below], [, foot]] = [await onScreen(page, at), await onScreen(page, [0, 0, 0])];
  assert.ok(below > foot, `${below} for ${foot}`);
  const time = await page.evaluate(() => window.platewash.time());
  await page.keyboard.press("Shift+ArrowUp");
  await page.keyboard.press("ArrowRight");
  await settled(page);
  const moved = await placeOf(page, "box 1");
  const way = [moved[0] - at[0], moved[1] - at[1]].map((step) => Math.round(1000 * Math.abs(step))).sort((a, b) => a - b);
  assert.deepEqual(way, [5, 50]);
  assert.equal(await page.evaluate(() => window.platewash.time()), time, "the film moved");
  await page.keyboard.press("Delete");
  await settled(page);
  assert.equal((await scenario(page)).trimEnd(), first.trimEnd());
  assert.ok(await page.getByRole("button", { name: "Add obstacle" }).evaluate((element) => element === document.activeElement));
  assert.equal(await row.count(), 0);
  quiet();
});

test("an obstacle is moved once it is clicked, and refused where it stands in a plate", async (t) => {
  const { page, quiet } = await edit(t, await folder(t), ["--scenario", "sink"]);
  const before = await scenario(page);
  const at = await placeOf(page, "near side");
  const to = [at[0] + 0.1, at[1], at[2]];
  // Not clicked: the view turns.
  await dragged(page, at, to);
  assert.equal(await scenario(page), before);
  await page.mouse.click(...(await onScreen(page, at)));
  await dragged(page, at, to, async (held) => {
    // A longer verdict and a film that goes do not move the scene under the pointer.
    await page.waitForFunction(() => /reaches.*reaches.*reaches/.test(window.platewash.edit.verdict().words));
    await page.evaluate(() => new Promise((drawn) => requestAnimationFrame(() => requestAnimationFrame(drawn))));
    assert.deepEqual(await onScreen(page, at), held);
  });
  const [line, ...more] = changedLines(before, await scenario(page));
  assert.deepEqual(more, []);
  assert.match(line, /^at_m = \[0\.2\d*, -?0(\.0\d*)?, 0\.05\]/);
  assert.equal((await verdict(page)).kind, "refused");
  assert.match((await verdict(page)).words, /'near side' reaches/);
  await page.evaluate(() => window.platewash.edit.undo());
  await settled(page);
  assert.equal(await scenario(page), before);
  assert.deepEqual(await placeOf(page, "near side"), at);
  assert.equal((await verdict(page)).kind, "proved");
  quiet();
});

test("plates of a kind that the seed draws stay, and the page says why", async (t) => {
  const { page, quiet } = await edit(t, await folder(t), ["--scenario", "sizes"]);
  const [before, at] = [await scenario(page), await page.evaluate(() => window.platewash.view.plates[0].pose.position_m)];
  await dragged(page, at, [at[0] + 0.08, at[1], at[2]]);
  assert.equal(await scenario(page), before);
  assert.match(await text(page), /give each section its at_m/);
  quiet();
});

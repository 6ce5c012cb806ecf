/** The picture holds what it should, where it should. */
import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import { test } from "node:test";
import { shipped } from "../lib/command.mjs";
import { changed, picture, projected, shares } from "../lib/picture.mjs";
import { address, open, seek } from "../lib/watched.mjs";

/** Colours in which objects are drawn, far apart in hue and from all others. */
const MARKERS = { arm: "#00ffff", plates: "#00ff00" };

/** Hue [°], saturation and lightness: those of the markers, of wash paths, of what is washed, and of the sponge. */
const KINDS = {
  cyan: { hue: [175, 185], saturation: [0.9, 1], lightness: [0.4, 0.6] },
  green: { hue: [115, 125], saturation: [0.9, 1], lightness: [0.4, 0.6] },
  magenta: { hue: [295, 335], saturation: [0.3, 1], lightness: [0.2, 0.8] },
  blue: { hue: [190, 225], saturation: [0.3, 1], lightness: [0.2, 0.8] },
  yellow: { hue: [35, 60], saturation: [0.4, 1], lightness: [0.2, 0.85] },
};

/** Prints a share of pixels with its limit, and fails where it is below it. */
function isSeen(t, what, share, least) {
  t.diagnostic(`${what}: ${share.toFixed(4)}, at least ${least}`);
  assert.ok(share >= least, `${what}: a share of ${share}, at least ${least} is required`);
}

/** The same of a share that must be small. */
function isHidden(t, what, share, most) {
  t.diagnostic(`${what}: ${share.toFixed(4)}, at most ${most}`);
  assert.ok(share <= most, `${what}: a share of ${share}, at most ${most} is allowed`);
}

/** Places of the floor in the shadow of the arm at its start [m]. */
const SHADED_M = [[-0.03, 0.3, 0], [-0.04, 0.38, 0], [0.1, 0.45, 0]];

/** Points of a plate's wash path, as the document has them. */
const pathOf = (page, plate) =>
  page.evaluate((plate) => {
    const { f32, f64 } = window.platewash.view.paths[plate].points_m;
    const { buffer } = Uint8Array.from(atob(f32 ?? f64), (letter) => letter.charCodeAt(0));
    const values = f32 === undefined ? new Float64Array(buffer) : new Float32Array(buffer);
    return [0.3, 0.5, 0.7, 0.9].map((share) => {
      const row = 3 * Math.floor((share * values.length) / 3);
      return [...values.subarray(row, row + 3)];
    });
  }, plate);

/** Shows the paths and the plates as they are before anything is washed. */
const bare = (page) =>
  page.evaluate(() => {
    const film = window.platewash;
    film.follow("planned");
    for (const layer of ["executed", "region", "coverage", "clearance"]) film.setLayer(layer, false);
  });

const setLayer = (page, layer, on) => page.evaluate(([layer, on]) => window.platewash.setLayer(layer, on), [layer, on]);
const camera = (page, view) => page.evaluate((view) => window.platewash.camera(view), view);

for (const colorScheme of ["light", "dark"]) {
  test(`arm, sponge, plates and wash paths are where they should be, ${colorScheme}`, async (t) => {
    const { page, quiet } = await open(t, address(await shipped()), { size: { width: 900, height: 800 }, colorScheme });
    await bare(page);
    await seek(page, 0);

    await camera(page, "overview");
    const tip = await projected(page, [await page.evaluate(() => window.platewash.tip())]);
    const [sponge] = await shares(page, await picture(page), tip, 24, KINDS);
    isSeen(t, "yellow at the tip", sponge.yellow, 0.1);

    await page.evaluate((markers) => {
      for (const [layer, colour] of Object.entries(markers)) window.platewash.setMarker(layer, colour);
    }, MARKERS);
    const column = await projected(page, [[0, 0, 0.1], [0, 0, 0.25]]);
    for (const { cyan } of await shares(page, await picture(page), column, 24, KINDS)) isSeen(t, "the arm's colour", cyan, 0.6);
    await setLayer(page, "arm", false);
    for (const { cyan } of await shares(page, await picture(page), column, 24, KINDS)) isHidden(t, "the hidden arm's colour", cyan, 0.05);
    await camera(page, "above");
    const points = await projected(page, [...(await pathOf(page, 0)), ...(await pathOf(page, 2))]);
    for (const { magenta } of await shares(page, await picture(page), points, 10, KINDS)) isSeen(t, "the wash path's colour", magenta, 0.1);

    const faces = await page.evaluate(() => window.platewash.view.plates.map((plate) => plate.pose.position_m));
    const places = await projected(page, faces);
    for (const { green } of await shares(page, await picture(page), places, 24, KINDS)) isSeen(t, "the plate's colour", green, 0.25);
    await setLayer(page, "plates", false);
    for (const { green } of await shares(page, await picture(page), places, 24, KINDS)) isHidden(t, "the hidden plate's colour", green, 0.05);
    quiet();
  });
}

test("an arm that is hidden casts no shadow", async (t) => {
  const { page, quiet } = await open(t, address(await shipped()), { size: { width: 900, height: 800 }, colorScheme: "light" });
  await bare(page);
  for (const layer of ["plates", "paths", "transits", "tip"]) await setLayer(page, layer, false);
  await seek(page, 0);
  await camera(page, "above");
  const places = await projected(page, SHADED_M);
  const with_arm = await picture(page);
  await setLayer(page, "arm", false);
  const without = await picture(page);
  for (const share of await changed(page, with_arm, without, places, 16)) isSeen(t, "of the floor in shadow that grows lighter", share, 0.6);
  await page.waitForTimeout(1500);
  for (const share of await changed(page, without, await picture(page), places, 16)) isHidden(t, "of it that changes later", share, 0.05);
  quiet();
});

test("what is washed is seen on the plates", async (t) => {
  const { page, quiet } = await open(t, address(await shipped()), { size: { width: 900, height: 800 } });
  await bare(page);
  for (const [layer, on] of [["coverage", true], ["paths", false], ["transits", false], ["tip", false]]) await setLayer(page, layer, on);
  await camera(page, "above");
  const duration = await page.evaluate(() => window.platewash.duration);
  const faces = await page.evaluate(() => window.platewash.view.plates.map((plate) => plate.pose.position_m));
  const places = await projected(page, faces);
  await seek(page, 0);
  for (const { blue } of await shares(page, await picture(page), places, 24, KINDS)) isHidden(t, "blue on a dry plate", blue, 0.1);
  await seek(page, duration);
  for (const { blue } of await shares(page, await picture(page), places, 24, KINDS)) isSeen(t, "blue on a washed plate", blue, 0.5);
  quiet();
});

test("the picture button saves the scene as a PNG", async (t) => {
  const { page, quiet } = await open(t, address(await shipped()), { size: { width: 900, height: 800 } });
  const [download] = await Promise.all([page.waitForEvent("download"), page.getByRole("button", { name: "Picture" }).click()]);
  assert.equal(download.suggestedFilename(), "platewash.png");
  const bytes = await readFile(await download.path());
  assert.equal(bytes.subarray(1, 4).toString(), "PNG");
  assert.ok(bytes.length > 20_000, `${bytes.length} bytes`);
  quiet();
});

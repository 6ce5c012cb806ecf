/** The picture holds what it should, where it should. */
import assert from "node:assert/strict";
import { test } from "node:test";
import { folder, page as written } from "../lib/command.mjs";
import { changed, picture, projected, shares } from "../lib/picture.mjs";
import { address, open, seek } from "../lib/watched.mjs";

/** Hue [°], saturation and lightness. */
const KINDS = {
  magenta: { hue: [295, 335], saturation: [0.3, 1], lightness: [0.2, 0.8] },
  blue: { hue: [190, 225], saturation: [0.3, 1], lightness: [0.2, 0.8] },
  yellow: { hue: [35, 60], saturation: [0.4, 1], lightness: [0.2, 0.85] },
  pale: { hue: [0, 360], saturation: [0, 0.45], lightness: [0.6, 1] },
};

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

for (const colorScheme of ["light", "dark"]) {
  test(`arm, sponge, plates and wash paths are where they should be, ${colorScheme}`, async (t) => {
    const file = await written(await folder(t));
    const { page, quiet } = await open(t, address(file), { size: { width: 900, height: 800 }, colorScheme });
    await bare(page);
    await seek(page, 0);

    await page.evaluate(() => window.platewash.camera("above"));
    const above = await picture(page);
    const points = [...(await pathOf(page, 0)), ...(await pathOf(page, 2))];
    const path = await shares(page, above, await projected(page, points), 10, KINDS);
    // The arm hides what is under it.
    const drawn = path.filter(({ magenta }) => magenta > 0.1).length;
    assert.ok(drawn >= points.length - 2, `no magenta on the wash paths: ${JSON.stringify(path)}`);

    const faces = await page.evaluate(() => window.platewash.view.plates.map((plate) => plate.pose.position_m));
    const places = await projected(page, faces);
    for (const [at, { pale }] of (await shares(page, above, places, 24, KINDS)).entries()) {
      assert.ok(pale > 0.4, `plate ${at + 1} is not pale: ${pale}`);
    }
    await page.evaluate(() => window.platewash.setLayer("plates", false));
    const without = await changed(page, above, await picture(page), places, 24);
    assert.ok(without.every((share) => share > 0.4), `plates that are hidden are still seen: ${without}`);
    await page.evaluate(() => window.platewash.setLayer("plates", true));

    await page.evaluate(() => window.platewash.camera("overview"));
    const overview = await picture(page);
    const [sponge] = await shares(page, overview, await projected(page, [await page.evaluate(() => window.platewash.tip())]), 24, KINDS);
    assert.ok(sponge.yellow > 0.1, `no sponge at the tip: ${JSON.stringify(sponge)}`);
    const column = await projected(page, [[0, 0, 0.1], [0, 0, 0.25]]);
    await page.evaluate(() => window.platewash.setLayer("arm", false));
    const gone = await changed(page, overview, await picture(page), column, 24);
    assert.ok(gone.every((share) => share > 0.7), `the arm that is hidden was not seen before: ${gone}`);
    quiet();
  });
}

test("what is washed is seen on the plates", async (t) => {
  const { page, quiet } = await open(t, address(await written(await folder(t))), { size: { width: 900, height: 800 } });
  await bare(page);
  await page.evaluate(() => {
    window.platewash.setLayer("coverage", true);
    window.platewash.setLayer("paths", false);
    window.platewash.camera("above");
  });
  const duration = await page.evaluate(() => window.platewash.duration);
  const faces = await page.evaluate(() => window.platewash.view.plates.map((plate) => plate.pose.position_m));
  await seek(page, 0);
  const dry = await picture(page);
  await seek(page, duration);
  const wet = await picture(page);
  const places = await projected(page, faces);
  const before = await shares(page, dry, places, 24, KINDS);
  const after = await shares(page, wet, places, 24, KINDS);
  after.forEach(({ blue }, at) => assert.ok(blue > before[at].blue + 0.4, `plate ${at + 1}: ${before[at].blue} then ${blue} blue`));
  quiet();
});

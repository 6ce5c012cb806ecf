/** Dirt, the paper's program beside the plan, and the tour of the proof. */
import assert from "node:assert/strict";
import { test } from "node:test";
import { shipped } from "../lib/command.mjs";
import { changed, picture, projected } from "../lib/picture.mjs";
import { address, open, seek, text } from "../lib/watched.mjs";

const SMALL = { size: { width: 480, height: 360 } };

const press = (page, words) => page.getByRole("button", { name: words }).click();

const frame = (page) => page.evaluate(() => window.platewash.step());

const shown = async (scenario) => address(await shipped(scenario));

test("the clean share grows to what is proved, and dirt can be hidden", async (t) => {
  const { page, quiet } = await open(t, await shown(), { size: { width: 900, height: 640 } });
  const { plate, at_least } = await page.evaluate(() => {
    const { plate, dose } = window.platewash.view.certificate.contact.plates[0];
    return { plate, at_least: dose.at_least };
  });
  const wash = await page.evaluate((plate) => window.platewash.view.segments.find((one) => one.kind === "wash" && one.plate === plate), plate);
  const clean = async (t) => {
    await seek(page, t);
    return Number(/clean, proved\s+([\d.]+)\s*%/.exec(await text(page))[1]) / 100;
  };
  const middle = await clean((wash.t_start_s + wash.t_end_s) / 2);
  const end = await clean(wash.t_end_s - 1e-3);
  assert.ok(middle > 0.1 && middle < end && end <= at_least && end > at_least - 0.03, `${middle}, ${end} of ${at_least}`);
  await seek(page, 0);
  const dirty = await picture(page);
  const centres = await page.evaluate(() => window.platewash.view.plates.map(({ pose }) => pose.position_m));
  await page.evaluate(() => window.platewash.setLayer("dirt", false));
  const bare = await picture(page);
  for (const share of await changed(page, dirty, bare, await projected(page, centres), 30)) assert.ok(share > 0.3, `${share} of a plate was dirty`);
  quiet();
});

test("the paper's program ends on the plan's clock, with what it leaves unwashed", async (t) => {
  const { page, quiet } = await open(t, await shown(), SMALL);
  await press(page, "Beside the paper");
  const { duration_s, headline } = await page.evaluate(() => window.platewash.view.beside);
  assert.ok(duration_s < 5);
  const shares = async (t) => {
    await seek(page, t);
    const found = await page.locator(".beside strong").allInnerTexts();
    return found.map((share) => Number.parseFloat(share) / 100);
  };
  assert.deepEqual(await shares(0), [0, 0]);
  const [plan, paper] = await shares(await page.evaluate(() => window.platewash.duration));
  assert.ok(plan > 0.99 && paper > 0.25 && paper < 0.5, `${plan}, ${paper}`);
  assert.ok((await text(page)).includes(headline));
  await press(page, "Beside the paper");
  await frame(page);
  assert.equal(await page.locator(".beside").isVisible(), false);
  quiet();
});

test("a cell that the paper's program does not know has none beside it", async (t) => {
  const { page, quiet } = await open(t, await shown("ceiling"), SMALL);
  assert.equal(await page.evaluate(() => window.platewash.view.beside), null);
  assert.equal(await page.getByRole("button", { name: "Beside the paper" }).count(), 0);
  quiet();
});

test("the tour stops at the worst places and ends in a card; Escape ends it", async (t) => {
  const { page, quiet } = await open(t, await shown(), SMALL);
  await page.evaluate(() => {
    window.now = 0;
    window.platewash.setClock(() => window.now);
  });
  const on = (seconds) => page.evaluate((ms) => {
    window.now += ms;
    window.platewash.step();
  }, 1000 * seconds);
  await press(page, "See the proof");
  const stops = await page.evaluate(() => {
    const { view, duration } = window.platewash;
    const placed = view.certificate.checks.filter(({ worst }) => worst.time_s !== undefined || worst.place_m !== undefined);
    return placed.map(({ words, worst }) => ({ words, t: worst.time_s ?? duration })).sort((a, b) => a.t - b.t);
  });
  await on(0.01);
  for (const { words, t } of stops) {
    for (let k = 0; k < 40 && !(await page.locator(".tour-label").innerText()).includes(words); k++) await on(0.9);
    assert.ok((await page.locator(".tour-label").innerText()).includes(words), words);
    assert.ok(Math.abs((await page.evaluate(() => window.platewash.time())) - t) < 1e-6, words);
  }
  const card = page.locator("dialog.proof-card");
  for (let k = 0; k < 40 && !(await card.isVisible()); k++) await on(0.9);
  assert.match(await card.locator("textarea").inputValue(), /^PROVED: 4 plates in .*\n- 31.requirements: 31 proved\n/);
  await page.waitForFunction(() => {
    const canvas = document.querySelector(".card-picture");
    return new Set(canvas.getContext("2d").getImageData(0, 300, 1200, 40).data).size > 20;
  });
  await page.keyboard.press("Escape");
  await card.waitFor({ state: "hidden" });
  await press(page, "See the proof");
  await on(0.1);
  assert.equal(await page.locator(".tour").isVisible(), true);
  await page.keyboard.press("Escape");
  assert.equal(await page.locator(".tour").isVisible(), false);
  quiet();
});

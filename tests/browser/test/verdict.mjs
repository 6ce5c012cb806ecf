/** What is not proved does not look proved. */
import assert from "node:assert/strict";
import { test } from "node:test";
import { join } from "node:path";
import { folder, page as written, platewash, shipped, spiral } from "../lib/command.mjs";
import { address, open } from "../lib/watched.mjs";

const header = (page) => page.evaluate(() => document.querySelector("header").innerText);
const background = (page) => page.evaluate(() => getComputedStyle(document.querySelector("header")).background);

test("a certificate that fails looks failed", async (t) => {
  const bad = await folder(t);
  // Windings that lie too far apart leave some of each plate unwashed.
  const scenario = await spiral(bad, ["turns = 3.5", "turns = 2"]);
  const proved = await open(t, address(await shipped()));
  const failed = await open(t, address(await written(bad, scenario, [4])));
  assert.match(await header(proved.page), /proved/i);
  assert.doesNotMatch(await header(proved.page), /not proved|violated/i);
  assert.match(await header(failed.page), /violated|not proved/i);
  assert.notEqual(await background(proved.page), await background(failed.page), "only words tell them apart");
  proved.quiet();
  failed.quiet();
});

test("without a certificate nothing is called proved", async (t) => {
  const { page, quiet } = await open(t, address(await shipped("paper-text")));
  assert.match(await header(page), /no certificate/i);
  assert.doesNotMatch(await header(page), /(?<!not )proved/i);
  quiet();
});

test("a dry run never looks like a washing", async (t) => {
  const place = await folder(t);
  await platewash(place, ["plan", "--quiet"]);
  await platewash(place, ["dry-run", "out/plan.json", "--quiet"]);
  await platewash(place, ["view", "out/dry-run/plan.json", "--save", "dry-run.html", "--quiet"]);
  const { page, quiet } = await open(t, address(join(place, "dry-run.html")));
  const [badges, words] = await page.evaluate(() => ["header .badges", "header .sentence"].map((at) => document.querySelector(at).innerText));
  assert.match(badges, /^dry run: proved$/i);
  assert.match(words, /^DRY RUN of [0-9a-f]{12}: 50 mm above the plates, nothing is washed; /);
  assert.match(await page.title(), /^Dry run: /);
  quiet();
});

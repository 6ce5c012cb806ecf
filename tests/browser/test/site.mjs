/** The website of the documentation from a plain file server: every page, on a narrow screen and without a network. */
import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import { join } from "node:path";
import { test } from "node:test";
import { needed } from "../lib/command.mjs";
import { serveFolder } from "../lib/static.mjs";
import { watch } from "../lib/watched.mjs";

const SITE = needed("PLATEWASH_SITE");
const NARROW = { width: 390, height: 300 };

test("every page of the website asks nothing of anybody else and fits on a narrow screen", { timeout: 900_000 }, async (t) => {
  const { url } = await serveFolder(t, SITE);
  const { page, quiet } = await watch(t, url, { size: NARROW });
  const { items } = JSON.parse(await readFile(join(SITE, "search.json"), "utf8"));
  const pages = new Set(["", ...items.map((item) => item.location.split("#")[0])]);
  assert.ok(pages.size > 35, `${pages.size} pages`);
  let formulas = 0;
  for (const place of pages) {
    await page.goto(url + place);
    assert.equal(await page.locator("h1").count(), 1, place);
    const width = await page.evaluate(() => document.documentElement.scrollWidth);
    assert.ok(width <= NARROW.width, `${place}: ${width} pixels wide`);
    formulas += await page.locator(".katex-display").count();
  }
  assert.ok(formulas > 25, `${formulas} formulas`);
  quiet();
});

test("the search of the website finds a page", { timeout: 900_000 }, async (t) => {
  const { url } = await serveFolder(t, SITE);
  const { page, quiet } = await watch(t, url, { size: NARROW });
  await page.goto(url);
  const [box, found] = [page.getByRole("combobox", { name: "Search" }), page.getByRole("option", { name: "Contact speed" })];
  const comes = (element) => element.waitFor({ timeout: 2000 }).then(() => true, () => false);
  // The page listens, and has its index, a moment after it is loaded.
  for (let tries = 0; !(await comes(box)); tries += 1) {
    assert.ok(tries < 100, "no search opens");
    await page.keyboard.press("Control+k");
  }
  for (let tries = 0; !(await comes(found)); tries += 1) {
    assert.ok(tries < 100, "nothing is found");
    await box.fill("");
    await box.fill("landing speed");
  }
  await found.click();
  await page.waitForURL("**/docs/certificate/**");
  quiet();
});

test("the website has the Rust API, the Python API and the playground", { timeout: 900_000 }, async (t) => {
  const { url } = await serveFolder(t, SITE);
  const { page } = await watch(t, url);
  await page.goto(url);
  const playground = await page.getByRole("link", { name: "Try it in the browser" }).getAttribute("href");
  for (const [place, words] of [[playground, /playground/i], ["rust/platewash/index.html", /struct\.Plan/]]) {
    assert.match(await (await fetch(new URL(place, url))).text(), words, place);
  }
  await page.goto(`${url}python-api/`);
  for (const name of ["plan", "prove", "Robot.ik", "Plate", "PlanError", "ros.write_bag"]) {
    const heading = page.locator(`[id="pyplatewash.${name}"]`);
    assert.equal(await heading.count(), 1, name);
    assert.notEqual((await heading.locator("xpath=following-sibling::*").first().innerText()).trim(), "", name);
  }
});

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
/** A desk's screen and a phone's. */
const SCREENS = [{ width: 1440, height: 900 }, { width: 390, height: 844 }];

/** The places of all pages. */
async function places() {
  const { items } = JSON.parse(await readFile(join(SITE, "search.json"), "utf8"));
  return [...new Set(["", ...items.map((item) => item.location.split("#")[0])])];
}

/** The places of pages with some text in them. */
async function placesWith(words) {
  const texts = await Promise.all((await places()).map(async (place) => [place, await readFile(join(SITE, place, "index.html"), "utf8")]));
  return texts.filter(([, text]) => text.includes(words)).map(([place]) => place);
}

/** How wide all of a page is [px]. */
const widthOf = (page) => page.evaluate(() => document.documentElement.scrollWidth);

/**
 * In the browser: the formulas of a page, and how each is drawn. Boxes are its parts between which a line may break, what is drawn in
 * them, and its number: their sizes, and places from the part's corner [px].
 */
async function formulasOf() {
  await document.fonts.ready;
  return [...document.querySelectorAll(".katex")].map((formula) => {
    const display = formula.closest(".katex-display");
    const own = display ?? formula;
    const rect = (element) => element.getBoundingClientRect();
    const boxes = [...formula.querySelectorAll(".katex-base, .katex-tag, svg")].map((element) => {
      const [box, part] = [rect(element), rect(element.closest(".katex-base") ?? element)];
      return [box.width, box.height, box.x - part.x, box.y - part.y];
    });
    const drawn = [...formula.querySelectorAll(".katex-base, .katex-base svg")].map(rect);
    const number = formula.querySelector(".katex-tag");
    const at = number && rect(number.lastElementChild);
    const under = (box) => box.left < at.right && box.right > at.left && box.top < at.bottom && box.bottom > at.top;
    return {
      words: formula.querySelector("annotation").textContent,
      html: own.outerHTML,
      size_px: parseFloat(getComputedStyle(own.parentElement).fontSize),
      boxes,
      signs: formula.querySelectorAll("svg").length,
      number: at && { free: !drawn.some(under), shown: at.left >= rect(display).left && at.right <= rect(display).right + 1 },
      cut: display !== null && { across: display.scrollWidth > display.clientWidth, down: display.scrollHeight > display.clientHeight },
    };
  });
}

test("every page of the website asks nothing of anybody else and fits on a narrow screen", { timeout: 900_000 }, async (t) => {
  const { url } = await serveFolder(t, SITE);
  const { page, quiet } = await watch(t, url, { size: NARROW });
  const pages = await places();
  assert.ok(pages.length > 35, `${pages.length} pages`);
  let formulas = 0;
  for (const place of pages) {
    await page.goto(url + place);
    assert.equal(await page.locator("h1").count(), 1, place);
    const width = await widthOf(page);
    assert.ok(width <= NARROW.width, `${place}: ${width} pixels wide`);
    formulas += await page.locator(".katex-display").count();
  }
  assert.ok(formulas > 25, `${formulas} formulas`);
  quiet();
});

for (const size of SCREENS) {
  test(`formulas are as large as KaTeX's own, and clear of their numbers, ${size.width} px wide`, { timeout: 900_000 }, async (t) => {
    const { url } = await serveFolder(t, SITE);
    const { page, quiet } = await watch(t, url, { size });
    const { page: blank } = await watch(t, url, { size });
    // Any file of the website's address, so that the blank page may load the fonts.
    await blank.goto(`${url}site.css`);
    let [numbers, signs] = [0, 0];
    for (const place of await placesWith('class="katex"')) {
      await page.goto(url + place);
      const drawn = await page.evaluate(formulasOf);
      const alone = drawn.map(({ html, size_px }) => `<div style="font-size: ${size_px}px">${html}</div>`);
      await blank.setContent(`<!doctype html><link rel="stylesheet" href="${url}assets/katex/katex.min.css">${alone.join("")}`);
      const own = await blank.evaluate(formulasOf);
      assert.equal(own.length, drawn.length, place);
      for (const [k, { words, boxes, number, cut, signs: here }] of drawn.entries()) {
        const name = `${place}: ${words}`;
        assert.equal(boxes.length, own[k].boxes.length, name);
        // The number's room to its formula, and its place, are the website's.
        boxes.forEach((box, part) => box.forEach((length, of) => {
          const expected = own[k].boxes[part][of];
          const slack = number !== null && part === boxes.length - 1 && of === 0 ? 16 : 0.5;
          assert.ok(Math.abs(length - expected) <= slack, `${name}: part ${part} is drawn ${box}, by KaTeX ${own[k].boxes[part]}`);
        }));
        if (number !== null) assert.deepEqual(number, { free: true, shown: true }, name);
        // On a phone a formula may scroll.
        if (cut !== false) assert.deepEqual({ ...cut, across: cut.across && size.width > 1000 }, { across: false, down: false }, name);
        numbers += number === null ? 0 : 1;
        signs += here;
      }
      const width = await widthOf(page);
      assert.ok(width <= size.width, `${place}: ${width} pixels wide`);
    }
    assert.ok(numbers > 25 && signs > 5, `${numbers} numbers, ${signs} signs such as roots`);
    quiet();
  });
}

for (const size of SCREENS) {
  test(`pictures are as wide as the text and open in full size, ${size.width} px wide`, { timeout: 900_000 }, async (t) => {
    const { url } = await serveFolder(t, SITE);
    const { page, quiet } = await watch(t, url, { size });
    const seen = new Set();
    for (const place of await placesWith("<img ")) {
      await page.goto(url + place);
      const pictures = await page.locator("article img").evaluateAll((images) => images.map((image) => {
        const link = image.closest("a");
        const gallery = link?.parentElement.querySelectorAll("img").length > 1;
        const text = image.closest("article").querySelector("h1").clientWidth;
        return { file: image.src, leads: link?.href, gallery, width: image.clientWidth, text };
      }));
      for (const { file, leads, gallery, width, text } of pictures) {
        assert.equal(leads, file, place);
        // Two pictures of a gallery stand beside each other where there is room.
        assert.ok(width >= (gallery && size.width > 1000 ? 0.45 : 1) * text, `${file}: ${width} of ${text} pixels wide`);
        seen.add(file);
      }
      const width = await widthOf(page);
      assert.ok(width <= size.width, `${place}: ${width} pixels wide`);
    }
    assert.ok(seen.size > 20, `${seen.size} pictures`);
    for (const file of seen) assert.equal((await fetch(file)).status, 200, file);
    quiet();
  });
}

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

/** A page loads from disk and from the server, and asks nobody else for anything. */
import assert from "node:assert/strict";
import { test } from "node:test";
import { folder, platewash, serve, shipped } from "../lib/command.mjs";
import { address, open, seek, text, watch } from "../lib/watched.mjs";

/** Draws a few moments and sees that something is there to be read. */
async function looksRight({ page, quiet }) {
  const duration = await page.evaluate(() => window.platewash.duration);
  assert.ok(duration > 1, `${duration} s`);
  for (const share of [0, 0.3, 0.9, 1]) await seek(page, share * duration);
  assert.ok(await page.evaluate(() => window.platewash.frame.count > 0), "no frame is drawn");
  assert.match(await text(page), /kitchen/i);
  quiet();
}

test("a page from disk asks nobody for anything", async (t) => {
  const file = await shipped();
  await looksRight(await open(t, address(file)));
});

test("a page from the server asks nobody else for anything", async (t) => {
  const place = await folder(t);
  await platewash(place, ["run", "--quiet"]);
  const { url } = await serve(t, place, ["view", "out/plan.json", "--no-open", "--port", "0"]);
  await looksRight(await open(t, url));
});

test("a narrow page has no room that one must scroll sideways for", async (t) => {
  const file = await shipped();
  const { page, quiet } = await open(t, address(file), { size: { width: 360, height: 640 } });
  const [wide, window] = await page.evaluate(() => [document.documentElement.scrollWidth, innerWidth]);
  assert.ok(wide <= window, `${wide} px in a window of ${window} px`);
  quiet();
});

test("before its first frame the scene says what is going on, and is not black", async (t) => {
  const url = address(await shipped());
  const { page, quiet } = await watch(t, url);
  await page.addInitScript(() => {
    new MutationObserver((_, observer) => {
      const canvas = document.querySelector("canvas.scene");
      if (canvas === null) return;
      const port = getComputedStyle(canvas.parentElement, "::before");
      window.atFirst = [getComputedStyle(canvas).visibility, port.content];
      observer.disconnect();
    }).observe(document, { childList: true, subtree: true });
  });
  await page.goto(url);
  await page.evaluate(() => window.platewash.ready);
  assert.deepEqual(await page.evaluate(() => window.atFirst), ["hidden", '"Drawing the cell …"']);
  assert.equal(await page.evaluate(() => getComputedStyle(document.querySelector("canvas.scene")).visibility), "visible");
  quiet();
});

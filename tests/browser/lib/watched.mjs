/** Pages that are watched: what they ask of whom, and what goes wrong in them. */
import assert from "node:assert/strict";
import { after } from "node:test";
import { pathToFileURL } from "node:url";
import { launch } from "./browser.mjs";

/** Longest wait for anything that a page does [ms]: a busy machine takes many times as long as an idle one. */
const PATIENCE_MS = 300_000;

/** Small, since every pixel is computed without a graphics processor. */
const SIZE = { width: 640, height: 480 };

let browser = null;
/** One for all tests. */
const shared = () => (browser ??= launch());
after(async () => (await browser)?.close());

/** A file's address. */
export const address = (file) => pathToFileURL(file).href;

/**
 * A page that will be opened at an address. `quiet()` fails where the page asked anything of anybody but its own place, or where an
 * error came up in it.
 */
export async function watch(test, url, { size = SIZE, ...context } = {}) {
  const own = await (await shared()).newContext({ viewport: size, reducedMotion: "reduce", ...context });
  test.after(() => own.close());
  own.setDefaultTimeout(PATIENCE_MS);
  const page = await own.newPage();
  const origin = new URL(url).origin;
  const wrong = [];
  page.on("request", (request) => {
    const asked = new URL(request.url());
    const inside = asked.protocol === "data:" || asked.protocol === "blob:";
    const same = origin === "null" ? request.url().split("#")[0] === url : asked.origin === origin;
    if (!inside && !same) wrong.push(`asked for ${request.url()}`);
  });
  page.on("console", (message) => {
    if (message.type() === "error") wrong.push(`console: ${message.text()}`);
  });
  page.on("pageerror", (error) => wrong.push(`error: ${error.message}`));
  return { page, wrong, quiet: () => assert.deepEqual(wrong, []) };
}

/** Opens a page and waits until it is ready; `quiet` as of `watch`. */
export async function open(test, url, settings = {}) {
  const { page, wrong, quiet } = await watch(test, url, settings);
  await page.goto(url);
  const began = await page.evaluate(() => window.platewash !== undefined);
  if (!began) throw new Error(`the page does not begin: ${wrong.join("; ")} ${await text(page)}`);
  await page.evaluate(() => window.platewash.ready);
  return { page, quiet };
}

/** Draws one frame at a time of the plan. */
export async function seek(page, t) {
  await page.evaluate((t) => {
    window.platewash.pause();
    window.platewash.seek(t);
    window.platewash.step();
  }, t);
}

/** The text of the page as a reader sees it. */
export const text = (page) => page.evaluate(() => document.body.innerText);

/** The playground from a plain file server: a proved wash in a browser that has nothing else, also without a network. */
import assert from "node:assert/strict";
import { createHash } from "node:crypto";
import { mkdtemp, readFile, rm, writeFile } from "node:fs/promises";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { test } from "node:test";
import { centres, drag, scenario, settled, verdict } from "../lib/cell.mjs";
import { folder, needed, platewash } from "../lib/command.mjs";
import { serveFolder } from "../lib/static.mjs";
import { text, watch } from "../lib/watched.mjs";

const WEB = needed("PLATEWASH_WEB");
const SIZE = { width: 1000, height: 640 };
const options = { timeout: 900_000 };

/** Waits until the engine is there, and everything is planned and drawn. */
async function ready(page) {
  await page.waitForFunction(() => window.platewash !== undefined, null, { polling: 20 });
  await page.evaluate(() => window.platewash.ready);
  await settled(page);
}

/** Opens the playground; `hash`: the link. */
async function open(t, hash = "", server = null) {
  const { url, stop } = server ?? (await serveFolder(t, WEB));
  const watched = await watch(t, url, { size: SIZE });
  const begun = performance.now();
  await watched.page.goto(url + hash);
  await ready(watched.page);
  return { ...watched, url, stop, took_ms: performance.now() - begun };
}

/** The hash of the plan that the command makes of the scenario on the page. */
async function commandsHash(t, page) {
  const place = await folder(t);
  await writeFile(join(place, "cell.toml"), await scenario(page));
  await platewash(place, ["plan", "--quiet", "--scenario", "cell.toml"]);
  return JSON.parse(await readFile(join(place, "out", "plan.json"), "utf8")).hash;
}

/** Drags the plate that has room beside it, and waits for the proof. */
async function dragged(page) {
  const [x, y] = (await centres(page))[1];
  const begun = performance.now();
  await drag(page, 1, [x - 0.03, y + 0.01]);
  const dropped = performance.now();
  await settled(page);
  assert.equal((await verdict(page)).kind, "proved");
  return { drag_ms: dropped - begun, proof_ms: performance.now() - dropped };
}

const hashOf = (page) => page.evaluate(() => window.platewash.view.heading.hash);

/** Chooses a line of a list of the toolbar. */
async function choose(page, list, value) {
  const menu = page.locator("details.tool-menu", { has: page.locator("summary", { hasText: list }) });
  await menu.locator("summary").click();
  await menu.locator(`[data-value="${value}"]`).click();
}

/** The files that come of a choice in the list of downloads, by name. */
async function downloads(page, value, count = 1) {
  const files = new Map();
  const all = new Promise((resolve) => {
    page.on("download", async (download) => {
      files.set(download.suggestedFilename(), await readFile(await download.path(), "utf8"));
      if (files.size === count) resolve();
    });
  });
  await choose(page, "Download", value);
  await all;
  page.removeAllListeners("download");
  return files;
}

test("a dragged plate is planned and proved as by the command, and again without a network", options, async (t) => {
  const { page, quiet, stop, took_ms } = await open(t);
  assert.equal((await verdict(page)).kind, "proved");
  const first = await dragged(page);
  assert.equal(await hashOf(page), await commandsHash(t, page));
  t.diagnostic(`first visit to first proof ${took_ms.toFixed(0)} ms; drop to drawn proof ${first.proof_ms.toFixed(0)} ms`);
  await page.evaluate(() => navigator.serviceWorker.ready);
  // The link in the address has the cell: it is there again, with no server left.
  const before = await scenario(page);
  await page.waitForFunction(() => location.hash.includes("cell="));
  await stop();
  await page.context().setOffline(true);
  await page.reload();
  await ready(page);
  assert.equal(await scenario(page), before);
  await page.evaluate(() => window.platewash.edit.change([{ key: "wash.speed_m_s", value: 0.2 }]));
  await settled(page);
  assert.equal(await hashOf(page), await commandsHash(t, page));
  quiet();
});

test("downloads are what the command writes", options, async (t) => {
  const { page, quiet } = await open(t, "#scenario=dessert");
  const place = await folder(t);
  const toml = await downloads(page, "scenario");
  assert.deepEqual([...toml.keys()], ["dessert.toml"]);
  await writeFile(join(place, "dessert.toml"), toml.get("dessert.toml"));
  await platewash(place, ["run", "--quiet", "--scenario", "dessert.toml"]);
  for (const name of ["plan.json", "certificate.json", "page.html"]) {
    const written = await readFile(join(place, "out", name), "utf8");
    const [[found, text]] = await downloads(page, name);
    assert.equal(found, name);
    assert.equal(digest(text), digest(written), name);
  }
  await platewash(place, ["export", "out/plan.json", "--to", "rapid", "--quiet"]);
  const [[name, program]] = await downloads(page, "rapid");
  assert.equal(digest(program), digest(await readFile(join(place, "out", "rapid", name), "utf8")));
  await choose(page, "Download", "urscript");
  await page.getByText("Not written: a URScript program is for an arm of Universal Robots").first().waitFor();
  quiet();
});

const digest = (text) => createHash("sha256").update(text).digest("hex");

test("a scenario is chosen, opened from a file and taken back", options, async (t) => {
  const { page, quiet } = await open(t, "#scenario=dessert");
  const first = await scenario(page);
  await choose(page, "Scenario", "rack");
  await settled(page);
  assert.match(await page.evaluate(() => window.platewash.view.heading.scenario), /^rack$/);
  await page.waitForFunction(() => location.hash.includes("scenario=rack"));
  const place = await mkdtemp(join(tmpdir(), "platewash-page-"));
  t.after(() => rm(place, { recursive: true, force: true }));
  const own = first.replace("[[plate]]", "# my own\n[[plate]]");
  await writeFile(join(place, "own.toml"), own);
  await page.locator("input[type=file]").setInputFiles(join(place, "own.toml"));
  // The page reads the file on its own: until then nothing is asked.
  await page.waitForFunction((text) => window.platewash.edit.text() === text, own);
  await settled(page);
  await page.evaluate(() => (window.platewash.edit.undo(), window.platewash.edit.undo()));
  assert.equal(await scenario(page), first);
  quiet();
});

test("address and downloads have the cell as it is, with what is being typed", options, async (t) => {
  const { page, quiet } = await open(t, "#scenario=dessert");
  await page.evaluate(() => window.platewash.edit.change([{ key: "wash.speed_m_s", value: 0.2 }]));
  await page.waitForFunction(() => location.hash.includes("cell="));
  await page.locator("a.skip").focus();
  await page.keyboard.press("Enter");
  await page.waitForFunction(() => location.hash.includes("cell="));
  const before = await page.evaluate(() => location.hash);
  await page.getByRole("tab", { name: "Text" }).click();
  const area = page.locator("textarea.scenario-text");
  await area.fill(`${await scenario(page)}# typed last\n`);
  const downloaded = page.waitForEvent("download");
  await page.keyboard.press("Control+s");
  const file = await downloaded;
  assert.equal(file.suggestedFilename(), "dessert.toml");
  assert.match(await readFile(await file.path(), "utf8"), /# typed last\n$/);
  // A reload keeps the cell, and what can be undone.
  await settled(page);
  const text = await scenario(page);
  await page.waitForFunction((before) => location.hash.replace(/^.*cell=/, "") !== before.replace(/^.*cell=/, ""), before);
  await page.reload();
  await ready(page);
  assert.equal(await scenario(page), text);
  assert.equal(await page.evaluate(() => window.platewash.edit.undo()), true);
  quiet();
});

test("a link that is broken, or has a broken scenario, is reported", options, async (t) => {
  const server = await serveFolder(t, WEB);
  const { page, quiet } = await open(t, "#cell=nothing", server);
  assert.match(await text(page), /The scenario in this link cannot be read.*“kitchen” is shown instead/);
  assert.equal((await verdict(page)).kind, "proved");
  const broken = await page.evaluate(async () => {
    const stream = new Blob(["seed = 1\nwash.tuns = 3\n"]).stream().pipeThrough(new CompressionStream("deflate-raw"));
    const bytes = new Uint8Array(await new Response(stream).arrayBuffer());
    return btoa(String.fromCharCode(...bytes)).replaceAll("+", "-").replaceAll("/", "_").replaceAll("=", "");
  });
  await page.evaluate((cell) => (location.hash = `#cell=${cell}`), broken);
  await page.getByText(/wash\.tuns/).first().waitFor();
  await settled(page);
  assert.equal((await verdict(page)).kind, "refused");
  // The same link in a tab of its own.
  const other = await open(t, `#cell=${broken}`, server);
  assert.equal((await verdict(other.page)).kind, "refused");
  assert.match(await text(other.page), /line 2/);
  quiet();
  other.quiet();
});

test("a browser without WebAssembly, or a folder without its engine, is told what is missing", options, async (t) => {
  const { url } = await serveFolder(t, WEB);
  const { page } = await watch(t, url, { size: SIZE });
  await page.addInitScript(() => {
    delete globalThis.WebAssembly;
  });
  await page.goto(url);
  await page.getByText("This browser cannot run platewash, which needs WebAssembly").waitFor();
  const other = await watch(t, url, { size: SIZE });
  await other.page.route("**/engine.bin", (route) => route.fulfill({ status: 404 }));
  await other.page.goto(url);
  await other.page.getByText("The engine cannot be loaded: the server answers 404 for engine.bin.").waitFor();
});

/** Nothing is lost: saving, files that change, connections that drop, servers that die, two tabs. */
import assert from "node:assert/strict";
import { access, readFile, rename, writeFile } from "node:fs/promises";
import { join } from "node:path";
import { test } from "node:test";
import { change, edit, scenario, settled, verdict } from "../lib/cell.mjs";
import { folder, platewash, serve, spiral } from "../lib/command.mjs";
import { open } from "../lib/watched.mjs";

const save = async (page) => {
  await page.evaluate(() => window.platewash.edit.save());
  await page.waitForFunction(() => !window.platewash.edit.unsaved());
};

/** Replaces a file whole, so that no look meets half of it. */
const replace = async (file, text) => {
  await writeFile(`${file}.new`, text);
  await rename(`${file}.new`, file);
};

const hash = (page) => page.evaluate(() => window.platewash.view.heading.hash);

test("what is saved plans and proves on the command line to the same hash", async (t) => {
  const place = await folder(t);
  const file = await spiral(place);
  const { page, quiet } = await edit(t, place, ["--scenario", "case.toml"]);
  await change(page, [{ key: "wash.speed_m_s", value: 0.2 }, { key: "layout.positions_m", value: [[0.17, -0.3], [0.42, 0.1]] }]);
  assert.equal((await verdict(page)).kind, "proved");
  await save(page);
  const text = await readFile(file, "utf8");
  assert.equal(text, await scenario(page));
  assert.match(text, /# windings 36 mm apart/);
  await platewash(place, ["run", "--quiet", "--scenario", "case.toml"]);
  const planned = JSON.parse(await readFile(join(place, "out", "plan.json"), "utf8"));
  assert.equal(planned.hash, await hash(page));
  const beside = JSON.parse(await readFile(join(place, "case.plan.json"), "utf8"));
  assert.equal(beside.hash, planned.hash);
  await platewash(place, ["verify", "case.plan.json", "--against", "case.toml"]);
  assert.match(await readFile(join(place, "case.report.txt"), "utf8"), /^PROVED/);
  await access(join(place, "case.page.html"));
  // A cell without a plan leaves no proof of the one before.
  await change(page, [{ key: "layout.positions_m", value: [[0.9, 0]] }]);
  await save(page);
  await assert.rejects(access(join(place, "case.plan.json")));
  assert.match(await readFile(join(place, "case.report.txt"), "utf8"), /^INFEASIBLE/);
  quiet();
});

test("a file that changes on disk is taken over where nothing is lost, and asked about where something is", async (t) => {
  const place = await folder(t);
  const file = await spiral(place);
  const { page } = await edit(t, place, ["--scenario", "case.toml"]);
  const first = await scenario(page);
  const other = first.replace("turns = 3.5", "turns = 3.25");
  await replace(file, other);
  await page.waitForFunction((text) => window.platewash.edit.text() === text, other);
  await settled(page);
  assert.equal((await verdict(page)).kind, "proved");
  await page.evaluate(() => window.platewash.edit.undo());
  assert.equal(await scenario(page), first);
  await page.evaluate(() => window.platewash.edit.redo());
  await change(page, [{ key: "seed", value: 7 }]);
  const mine = await scenario(page);
  await replace(file, first);
  await page.getByRole("button", { name: /keep mine/i }).click();
  assert.equal(await scenario(page), mine);
  await replace(file, other.replace("3.25", "3.75"));
  await page.getByRole("button", { name: /take it/i }).click();
  await settled(page);
  assert.match(await scenario(page), /turns = 3\.75/);
  // A save between two looks does not overwrite what is there.
  await change(page, [{ key: "seed", value: 8 }]);
  await replace(file, "# somebody else's\n" + first);
  await page.evaluate(() => window.platewash.edit.save());
  await page.getByRole("button", { name: /overwrite|keep mine/i }).first().waitFor();
  assert.match(await readFile(file, "utf8"), /^# somebody else's/);
});

test("a reload goes on where the page was, and another tab knows nothing of it", async (t) => {
  const place = await folder(t);
  const { page, server } = await edit(t, place);
  const first = await scenario(page);
  await change(page, [{ key: "seed", value: 3 }]);
  await change(page, [{ key: "wash.turns", value: 3.75 }]);
  const changed = await scenario(page);
  await page.reload();
  await page.evaluate(() => window.platewash.ready);
  await settled(page);
  assert.equal(await scenario(page), changed);
  const other = await page.context().newPage();
  await other.goto(server.url);
  await other.evaluate(() => window.platewash.ready);
  await settled(other);
  assert.equal(await scenario(other), first);
  await Promise.all([
    change(page, [{ key: "layout.count", value: 3 }]),
    change(other, [{ key: "layout.count", value: 2 }]),
  ]);
  for (const [tab, count] of [[page, 3], [other, 2]]) {
    assert.equal((await verdict(tab)).kind, "proved");
    assert.equal(await tab.evaluate(() => window.platewash.edit.centres().length), count);
  }
  assert.equal(await page.evaluate(() => window.platewash.edit.undo() && window.platewash.edit.undo() && window.platewash.edit.undo()), true);
  assert.equal(await scenario(page), first);
});

test("a server that is killed and started again finds the page as it was", async (t) => {
  const place = await folder(t);
  const server = await serve(t, place, ["edit", "--no-open"]);
  const { page } = await open(t, server.url, { size: { width: 900, height: 600 } });
  await settled(page);
  const port = new URL(server.url).port;
  server.kill("SIGKILL");
  await server.ended;
  await page.evaluate(() => window.platewash.edit.change([{ key: "seed", value: 11 }]));
  await page.waitForFunction(() => window.platewash.edit.verdict().kind === "lost");
  // The words follow with the next frame.
  await page.waitForFunction(() => /the connection to platewash is lost/i.test(document.body.innerText));
  const again = await serve(t, place, ["edit", "--no-open", "--port", port]);
  // The page that the new server opens brings its token; the old one then goes on.
  const other = await page.context().newPage();
  await other.goto(again.url);
  await settled(other);
  assert.equal(new URL(other.url()).hash.includes("token"), false);
  await page.waitForFunction(() => window.platewash.edit.verdict().kind === "proved");
  await settled(page);
  assert.match(await scenario(page), /seed = 11/);
  await save(page);
  assert.match(await readFile(join(place, "kitchen.toml"), "utf8"), /seed = 11/);
});

/** A plate in the hand: where it can be washed it is planned and proved, elsewhere the page says why and shows a place. */
import assert from "node:assert/strict";
import { test } from "node:test";
import { centres, change, drag, edit, onScreen, scenario, settled, verdict } from "../lib/cell.mjs";
import { folder, kitchen } from "../lib/command.mjs";
import { text } from "../lib/watched.mjs";

/** The kitchen with one plate, which is planned and proved sooner. */
async function one(t) {
  const place = await folder(t);
  await kitchen(place, ["count = 4", "count = 1"]);
  return edit(t, place, ["--scenario", "case.toml"]);
}

/** Pixels are some millimetres wide. */
const NEAR_M = 0.012;

const apart = ([a, b], [c, d]) => Math.hypot(a - c, b - d);

test("a drag to a washable place leads to a proved plan of the plate there", async (t) => {
  const { page, quiet } = await edit(t, await folder(t));
  const before = await centres(page);
  assert.equal((await verdict(page)).kind, "proved");
  const hash = await page.evaluate(() => window.platewash.view.heading.hash);
  // The one that has room beside it.
  const plate = 1;
  const to = [before[plate][0] - 0.03, before[plate][1] + 0.01];
  await drag(page, plate, to);
  await settled(page);
  const after = await centres(page);
  assert.ok(apart(after[plate], to) < NEAR_M, `${after[plate]} for ${to}`);
  assert.deepEqual(after.toSpliced(plate, 1), before.toSpliced(plate, 1));
  assert.equal((await verdict(page)).kind, "proved");
  assert.match(await text(page), /proved/i);
  assert.notEqual(await page.evaluate(() => window.platewash.view.heading.hash), hash);
  // The film shows the new plan: the tip is over the plate where it is now.
  const over = await page.evaluate((plate) => {
    const { segments } = window.platewash.view;
    const wash = segments.find((segment) => segment.kind === "wash" && segment.plate === plate);
    window.platewash.pause();
    window.platewash.seek(wash.t_start_s);
    window.platewash.step();
    return window.platewash.tip();
  }, plate);
  assert.ok(apart(over, after[plate]) < 0.15, `${over}`);
  quiet();
});

test("a drag out of reach leads to the reason and a ghost, and a click on the ghost to a proved plan", async (t) => {
  const { page, quiet } = await one(t);
  const from = (await centres(page))[0];
  const away = Math.hypot(...from);
  await drag(page, 0, from.map((c) => (c * 0.62) / away));
  await settled(page);
  const said = await verdict(page);
  assert.equal(said.kind, "unplanned");
  assert.match(said.words, /cannot be washed|no way to wash/);
  assert.match(await text(page), /out of reach by up to/);
  const ghost = await page.evaluate(() => window.platewash.edit.ghosts()[0]);
  assert.equal(ghost.plate, 0);
  const [x, y] = await onScreen(page, [...ghost.centre_m, 0.03]);
  await page.mouse.click(x, y);
  await settled(page);
  assert.deepEqual((await centres(page))[0], ghost.centre_m);
  assert.equal((await verdict(page)).kind, "proved");
  quiet();
});

test("what a held plate was proved with is the last valid plan once it is dragged out of reach", async (t) => {
  const { page, quiet } = await one(t);
  const facts = () => page.locator("#header .facts dd").allInnerTexts();
  const before = await facts();
  const [x, y] = (await centres(page))[0];
  const away = Math.hypot(x, y);
  await drag(page, 0, [x + 0.06, y - 0.02], { release: false });
  // Held still, it is planned and proved there.
  await page.waitForFunction(
    (hash) => document.querySelector("#header .badge").textContent === "Proved" && document.querySelector("#header .facts code").textContent !== hash,
    before[1].trim(),
  );
  const held = await facts();
  const [outX, outY] = await onScreen(page, [(x * 0.62) / away, (y * 0.62) / away, 0.03]);
  await page.mouse.move(outX, outY);
  await page.mouse.up();
  await settled(page);
  assert.equal((await verdict(page)).kind, "unplanned");
  assert.deepEqual(await page.locator("#header .facts dt").allInnerTexts(), ["last valid cycle", "last valid hash"]);
  assert.deepEqual(await facts(), held);
  await page.getByRole("tab", { name: "Proof" }).click();
  const proof = await page.locator("#panel-requirements").innerText();
  assert.match(proof, /\d+.requirements: \d+ proved/);
  assert.doesNotMatch(proof, /nothing was proved/);
  quiet();
});

test("sixty changes and as many undos give the first scenario byte for byte", async (t) => {
  const { page, quiet } = await edit(t, await folder(t));
  const first = await scenario(page);
  // A small generator, so that each run draws the same.
  let state = 120;
  const next = (n) => {
    state = (Math.imul(state, 1103515245) + 12345) & 0x7fffffff;
    return (state >>> 8) % n;
  };
  const draws = [
    () => ({ key: "wash.turns", value: 2 + next(40) / 10 }),
    () => ({ key: "layout.count", value: 1 + next(4) }),
    () => ({ key: "seed", value: next(1000) }),
    () => ({ key: "wash.tilt_max_deg", value: next(60) }),
    () => ({ key: "tool.com_m", value: next(2) === 0 ? null : next(100) / 1000 }),
    () => ({ key: "layout.positions_m", value: next(3) === 0 ? null : [[0.3, next(100) / 500], [-0.2, -0.3]] }),
    () => ({ key: "name", value: `cell ${next(9)} # "quoted" 'and' \\ ü` }),
    () => ({ key: "job.order", value: ["nearest", "given", "fastest"][next(3)] }),
  ];
  const edits = Array.from({ length: 60 }, () => draws[next(draws.length)]());
  const texts = await page.evaluate(async (edits) => {
    const { edit } = window.platewash;
    const texts = new Set();
    for (const one of edits) {
      edit.change([one]);
      while (!edit.written()) await new Promise((resolve) => setTimeout(resolve, 2));
      texts.add(edit.text());
    }
    return texts.size;
  }, edits);
  assert.ok(texts > 30, `${texts} texts`);
  const last = await scenario(page);
  const steps = await page.evaluate(() => {
    let steps = 0;
    while (window.platewash.edit.undo()) steps += 1;
    return steps;
  });
  assert.ok(steps > 45, `${steps} steps`);
  assert.equal(await scenario(page), first);
  await page.evaluate(() => {
    while (window.platewash.edit.redo());
  });
  assert.equal(await scenario(page), last);
  await page.evaluate(() => {
    while (window.platewash.edit.undo());
  });
  await settled(page);
  assert.equal((await verdict(page)).kind, "proved");
  quiet();
});

test("with the keyboard alone a cell is broken, mended and saved", async (t) => {
  const { page, quiet } = await edit(t, await folder(t));
  await page.locator("canvas.scene").focus();
  const [before] = await centres(page);
  await page.keyboard.press("n");
  assert.equal(await page.evaluate(() => window.platewash.edit.selected()), 0);
  for (let k = 0; k < 8; k++) await page.keyboard.press("Shift+ArrowDown");
  await settled(page);
  const moved = (await centres(page))[0];
  assert.ok(Math.abs(apart(moved, before) - 0.4) < 1e-5, `${moved}`);
  assert.equal((await verdict(page)).kind, "unplanned");
  await page.keyboard.press("Enter");
  await settled(page);
  assert.equal((await verdict(page)).kind, "proved");
  // Steps that follow each other soon are one: how many there are depends on how fast the machine is.
  for (let k = 0; k < 9 && String((await centres(page))[0]) !== String(before); k++) {
    await page.keyboard.press("Control+z");
    await settled(page);
  }
  assert.deepEqual((await centres(page))[0], before);
  await page.keyboard.press("Control+s");
  await page.waitForFunction(() => !window.platewash.edit.unsaved());
  const heard = await page.evaluate(() => document.getElementById("announcer").textContent);
  assert.match(heard, /saved|proved/i);
  quiet();
});

test("the form knows every key, refuses what does not fit and says what was meant", async (t) => {
  const { page, quiet } = await one(t);
  await page.getByRole("tab", { name: "Settings" }).click();
  const keys = await page.evaluate(() => JSON.parse(document.getElementById("platewash-edit").textContent).keys.map(({ path }) => path));
  const shown = await page.evaluate(() => [...document.querySelectorAll("[data-key]")].map((row) => row.dataset.key));
  assert.deepEqual([...shown].sort(), [...keys].sort());
  const tilt = page.locator('[data-key="wash.tilt_max_deg"] input');
  const first = await scenario(page);
  await tilt.fill("90");
  await tilt.press("Enter");
  await settled(page);
  assert.equal(await tilt.getAttribute("aria-invalid"), "true");
  assert.match(await page.locator('[data-key="wash.tilt_max_deg"]').innerText(), /from 0 to 60/);
  assert.equal(await scenario(page), first);
  await tilt.fill("20");
  await tilt.press("Enter");
  await settled(page);
  assert.match(await scenario(page), /tilt_max_deg = 20(\.0)?\s/);
  await page.getByRole("searchbox").fill("wash.tilt_mx_deg");
  assert.match(await page.locator("#panel-keys").innerText(), /did you mean.*wash\.tilt_max_deg/is);
  quiet();
});

test("a change of a key is shown with its refusal, and the plan of before stays in sight", async (t) => {
  const { page, quiet } = await one(t);
  await change(page, [{ key: "robot.start_deg", value: [0, 0, 0, 0, 200, 0] }]);
  assert.equal((await verdict(page)).kind, "refused");
  assert.match((await verdict(page)).words, /robot\.start_deg/);
  assert.ok(await page.evaluate(() => window.platewash.view.motion !== null));
  // Nothing looks proved: the badge, the rows, cycle and hash, and the film that would show the plan of before.
  assert.match(await page.locator("#header .badge").innerText(), /refused/i);
  assert.deepEqual(await page.locator("#header .facts dt").allInnerTexts(), ["last valid cycle", "last valid hash"]);
  assert.deepEqual(await page.locator(".row .status").allInnerTexts(), ["Not planned"]);
  await page.evaluate(() => window.platewash.play());
  assert.equal(await page.evaluate(() => window.platewash.isPlaying()), false);
  assert.equal(await page.locator(".play-button").isDisabled(), true);
  await page.evaluate(() => window.platewash.edit.undo());
  await settled(page);
  assert.equal((await verdict(page)).kind, "proved");
  assert.deepEqual(await page.locator("#header .facts dt").allInnerTexts(), ["cycle", "hash"]);
  assert.equal(await page.locator(".play-button").isDisabled(), false);
  quiet();
});

test("what is typed and not applied does not stand beside a verdict", async (t) => {
  const { page, quiet } = await one(t);
  const badge = page.locator("#header .badge").first();
  assert.match(await badge.innerText(), /proved/i);
  await page.getByRole("tab", { name: "Settings" }).click();
  const speed = page.locator('[data-key="wash.speed_m_s"] input');
  await speed.fill("0.2");
  await badge.getByText("Not applied").waitFor();
  await speed.press("Escape");
  await badge.getByText("Proved").waitFor();
  quiet();
});

test("a map shows where a plate could lie, and goes when the cell changes", async (t) => {
  const { page, quiet } = await edit(t, await folder(t));
  await page.getByRole("button", { name: "Where?" }).first().click();
  const words = page.locator(".map-words");
  await words.getByText("Not planned, not proved").waitFor();
  await change(page, [{ key: "seed", value: 2 }]);
  assert.equal(await words.isVisible(), false);
  quiet();
});

test("after a stop the page shows the proved way home and what is left, and the plan again", async (t) => {
  const { page, quiet } = await edit(t, await folder(t));
  const plan = await page.evaluate(() => {
    const { segments, heading } = window.platewash.view;
    const wash = segments.filter((segment) => segment.kind === "wash")[1];
    window.platewash.pause();
    window.platewash.seek(0.5 * (wash.t_start_s + wash.t_end_s));
    return { hash: heading.hash, plate: wash.plate, time: 0.5 * (wash.t_start_s + wash.t_end_s) };
  });
  const said = () => page.evaluate(() => window.platewash.edit.recovery());
  const wait = (words) => page.waitForFunction((words) => window.platewash.edit.recovery()?.includes(words), words);
  await page.getByRole("tab", { name: "Cell" }).click();
  await page.getByRole("button", { name: "Recover", exact: true }).click();
  await wait("Shown: the motion home");
  assert.match(await said(), /as stated.*washed by then: plate \d+\. Shown: the motion home\. Then the rest: REST of a stopped plan, without plate \d+; PROVED/);
  await page.waitForFunction(() => window.platewash.view.segments.length === 2);
  assert.match(await text(page), /RECOVERY: from the stop home/);
  const segments = await page.evaluate(() => window.platewash.view.segments.map(({ kind, plate }) => [kind, plate]));
  assert.deepEqual(segments, [["retreat", plan.plate], ["return", plan.plate]]);
  assert.equal(await page.evaluate(() => window.platewash.time()), 0);
  await page.getByRole("button", { name: "Back to the plan" }).click();
  await page.waitForFunction((hash) => window.platewash.view.heading.hash === hash, plan.hash);
  assert.ok(Math.abs((await page.evaluate(() => window.platewash.time())) - plan.time) < 1e-3);
  // Joints as they are typed; what is none is refused, and so is what touches.
  const joints = page.getByRole("textbox", { name: /^Joint positions where the arm stands/ });
  await joints.fill("0 0 0");
  await joints.press("Enter");
  await wait("expected six numbers");
  await joints.fill("0 80 0 0 30 0");
  await joints.press("Enter");
  await wait("touch");
  assert.equal(await page.evaluate(() => window.platewash.view.heading.hash), plan.hash);
  quiet();
});

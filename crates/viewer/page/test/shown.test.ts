import assert from "node:assert/strict";
import { test } from "node:test";
import { CellShown } from "../src/edit/shown.ts";
import type { Editing } from "../src/scene/editing.ts";
import type { View } from "../src/view.ts";
import { CELL, newCell, PLAN, PROOF } from "./fake-cell.ts";

const plate = (x: number): unknown => ({ name: "p", pose: { position_m: [x, 0, 0.03], quaternion_wxyz: [1, 0, 0, 0] } });
const FIRST = { version: "1", arm: { name: "a" }, plates: [], certificate: null } as unknown as View;
const drawn = (x: number): object => ({ ...CELL, heading: { scenario: "x" }, plates: [plate(x), plate(0.4)], centres_m: [[x, 0], [0.4, 0]] });

function shown(): { views: View[]; said: unknown[][]; update: (now: number) => void } & ReturnType<typeof newCell> {
  const made = newCell();
  const views: View[] = [];
  const said: unknown[][] = [];
  const scene = new Proxy({}, { get: (_, name) => (...given: unknown[]) => said.push([name, ...given]) }) as Editing;
  const of = new CellShown(FIRST, () => scene, (view) => views.push(view));
  made.cell.start();
  return { ...made, views, said, update: (now) => of.update(made.cell, now) };
}

test("first the cell, then its plan, then its proof: the arm stays the same object", () => {
  const { channel, views, update } = shown();
  const asked = channel.last("proof");
  asked.say(drawn(0.1));
  update(0);
  assert.equal(views.length, 1);
  asked.say({ ...PLAN, paths: [], segments: [], motion: null, clearance: null, coverage: [], heading: { scenario: "x" } });
  update(1);
  update(2);
  asked.say(PROOF);
  update(3);
  assert.deepEqual(views.map(({ certificate }) => certificate !== null), [false, false, true]);
  assert.ok(views.every(({ arm }) => arm === FIRST.arm));
  assert.equal(views[1]!.paths, views[2]!.paths);
});

test("the film of before stays while its plan is waited for, with the plates where they are now; then it goes", async () => {
  const { cell, channel, views, said, update } = shown();
  channel.last("proof").say(drawn(0.1), { ...PLAN, coverage: [] }, PROOF);
  await channel.last("proof").end();
  update(0);
  assert.equal(views.length, 1);
  cell.place([[0.2, 0], [0.4, 0]], "Move");
  channel.last("proof").say(drawn(0.2));
  update(100);
  update(600);
  assert.equal(views.length, 1);
  assert.deepEqual(said.filter(([name]) => name === "preview").at(-1), ["preview", [[0.2, 0], [0.4, 0]]]);
  update(800);
  assert.equal(views.length, 2);
  assert.equal(views[1]!.certificate, null);
});

test("unwashable plates are marked with other positions until a change", async () => {
  const { cell, channel, said, update } = shown();
  const bad = { plate: 1, proved: true, words: "", causes: [], share: null, free_m: [], dead_m: [[0.4, 0, 0]] };
  const asked = channel.last("proof");
  asked.say(drawn(0.1), { kind: "unplanned", headline: "no", reason: "", proved: true, plates: [bad], ms: {} }, { kind: "place", plate: 1, nearest_m: [0.3, 0], searched_m: 1, ms: {} }, { kind: "place", plate: 0, nearest_m: null, searched_m: 1, ms: {} });
  await asked.end();
  update(0);
  const last = (name: string): unknown => said.findLast(([of]) => of === name)?.[1];
  assert.deepEqual(last("offending"), [{ plate: 1, free_m: [], dead_m: [[0.4, 0, 0]] }]);
  assert.deepEqual(last("chances"), [{ plate: 1, chance: "unwashable" }]);
  assert.deepEqual(last("ghosts"), [{ plate: 1, centre_m: [0.3, 0] }]);
  cell.place([[0.1, 0], [0.3, 0]], "Move");
  update(1);
  assert.deepEqual([last("offending"), last("ghosts"), last("chances")], [[], [], []]);
});

test("a refusal changes nothing of what is shown", async () => {
  const { cell, channel, views, update } = shown();
  channel.last("proof").say(drawn(0.1), { ...PLAN, coverage: [] }, PROOF);
  await channel.last("proof").end();
  update(0);
  cell.change([{ key: "a", value: 1 }], "a");
  channel.last("proof").say({ kind: "refused", words: "no", key: "a", line: null, ms: {} });
  await channel.last("proof").end();
  for (let now = 0; now < 3000; now += 100) update(now);
  assert.equal(views.length, 1);
  assert.ok(views[0]!.certificate);
});

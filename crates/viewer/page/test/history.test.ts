import assert from "node:assert/strict";
import { test } from "node:test";
import { changed, History, Keeper, type Kept, sameVersion, type Store, type Version } from "../src/edit/history.ts";
import { newCell, written } from "./fake-cell.ts";

const text = (words: string): Version => ({ text: words, edits: [] });

/** The same numbers each time (mulberry32). */
function random(seed: number): () => number {
  let state = seed;
  return () => {
    state = (state + 0x6d2b79f5) | 0;
    let t = Math.imul(state ^ (state >>> 15), 1 | state);
    t = (t + Math.imul(t ^ (t >>> 7), 61 | t)) ^ t;
    return ((t ^ (t >>> 14)) >>> 0) / 4294967296;
  };
}

test("undo and redo go through every step, and a new step ends what was undone", () => {
  const history = new History([{ version: text("0"), label: "" }]);
  for (const words of ["1", "2", "3"]) assert.equal(history.commit(text(words), `to ${words}`), true);
  assert.equal(history.commit(text("3"), "again"), false);
  assert.deepEqual([history.undoes, history.redoes], ["to 3", null]);
  assert.equal(history.undo() && history.undo(), true);
  assert.deepEqual([history.version.text, history.undoes, history.redoes], ["1", "to 1", "to 2"]);
  history.commit(text("4"), "to 4");
  assert.deepEqual([history.redo(), history.steps.length], [false, 3]);
  while (history.undo());
  assert.equal(history.version.text, "0");
});

test("a step equal to the one before is not recorded", () => {
  const history = new History([{ version: text("a"), label: "" }]);
  history.commit({ text: "a", edits: [{ key: "x", value: 1 }] }, "x");
  history.settle(text("a"));
  assert.deepEqual([history.steps.length, history.at, history.undoes], [1, 0, null]);
});

test("random edits: undo to the start is the first text, redo to the end the last", async () => {
  for (let seed = 1; seed <= 40; seed++) {
    const next = random(seed);
    const first = `name = "${seed}"`;
    const { cell, channel, time } = newCell(first);
    cell.start();
    for (let k = 0; k < 30; k++) {
      const pick = next();
      const key = `k${Math.floor(next() * 4)}`;
      if (pick < 0.35) cell.change([{ key, value: Math.floor(next() * 3) }], key, next() < 0.5 ? key : null);
      else if (pick < 0.45) cell.change([{ key, value: null }], key);
      else if (pick < 0.6) {
        for (let step = 0; step < 3; step++) cell.drag([[Math.floor(next() * 5), 0], [1, 1]]);
        if (next() < 0.7) cell.drop("drag");
        else cell.cancelDrag();
      } else if (pick < 0.75) cell.undo();
      else if (pick < 0.85) cell.redo();
      else cell.setText(`name = "${Math.floor(next() * 3)}"`, "text");
      if (next() < 0.6 && channel.last("proof").signal.aborted === false) await channel.last("proof").proved();
      time.pass(next() * 1500);
    }
    while (cell.history.redoes !== null) cell.redo();
    const last = cell.version;
    const steps = cell.history.steps.length;
    while (cell.history.undoes !== null) cell.undo();
    assert.equal(written({ ...cell.version, edits: [...cell.version.edits], session: "", want: "proof", arm: null, guessed: false }), first, `seed ${seed}`);
    for (let k = 1; k < steps; k++) cell.redo();
    assert.ok(sameVersion(cell.version, last), `seed ${seed}`);
    cell.history.steps.forEach(({ version }, k) => {
      const before = cell.history.steps[k - 1];
      if (before !== undefined) assert.ok(!sameVersion(before.version, version), `seed ${seed}: step ${k} is none`);
    });
  }
});

test("the last change of a key counts", () => {
  const base = { text: "t", edits: [{ key: "a", value: 1 }, { key: "b", value: 2 }] };
  assert.deepEqual(changed(base, [{ key: "a", value: 3 }, { key: "a", value: null }]).edits, [{ key: "b", value: 2 }, { key: "a", value: null }]);
  assert.deepEqual(base.edits.length, 2);
});

class Tab implements Store {
  readonly entries = new Map<string, string>();
  readonly room: number;

  constructor(room = Number.POSITIVE_INFINITY) {
    this.room = room;
  }

  getItem(key: string): string | null {
    return this.entries.get(key) ?? null;
  }

  setItem(key: string, value: string): void {
    if (value.length > this.room) throw new DOMException("full", "QuotaExceededError");
    this.entries.set(key, value);
  }

  removeItem(key: string): void {
    this.entries.delete(key);
  }
}

const steps = (count: number, size: number): Kept["steps"] => Array.from({ length: count }, (_, k) => ({ version: { text: `${k}`.padEnd(size, "."), edits: [] }, label: `${k}` }));

test("stored steps are restored for the same file only", () => {
  const tab = new Tab();
  const what: Kept = { steps: steps(3, 5), at: 1, disk: "d", saved: "s" };
  new Keeper(tab, "a.toml").save(what);
  assert.deepEqual(new Keeper(tab, "a.toml").load(), what);
  assert.equal(new Keeper(tab, "b.toml").load(), null);
});

test("where there is no room, the steps around the present one are stored", () => {
  const tab = new Tab(500_000);
  const keeper = new Keeper(tab, "a");
  keeper.save({ steps: steps(100, 30_000), at: 60, disk: null, saved: null });
  assert.equal(keeper.works, true);
  const found = keeper.load()!;
  assert.equal(found.steps[found.at]!.label, "60");
  assert.ok(found.steps.length > 8 && found.steps.length < 17, String(found.steps.length));
});

test("a tab without storage reports it and does not fail", () => {
  const full = new Keeper(new Tab(10), "a");
  full.save({ steps: steps(2, 100), at: 0, disk: null, saved: null });
  assert.equal(full.works, false);
  assert.equal(full.load(), null);
  const none = new Keeper(null, "a");
  none.save({ steps: steps(1, 1), at: 0, disk: null, saved: null });
  assert.deepEqual([none.works, none.load()], [false, null]);
});

test("foreign stored data are ignored", () => {
  const tab = new Tab();
  new Keeper(tab, "a").save({ steps: steps(1, 1), at: 0, disk: null, saved: null });
  const [key] = tab.entries.keys();
  for (const text of ["", "{", "null", "3", "{\"steps\":[]}", "{\"steps\":[{}]}", "{\"steps\":[{\"label\":\"x\",\"version\":{\"text\":3,\"edits\":[]}}]}"]) {
    tab.entries.set(key!, text);
    assert.equal(new Keeper(tab, "a").load(), null, text);
  }
  tab.entries.set(key!, JSON.stringify({ steps: steps(2, 1), at: 99 }));
  assert.equal(new Keeper(tab, "a").load()?.at, 1);
});

test("sections are taken out after all other changes, those behind first", () => {
  const remove = (k: number): { key: string; value: null } => ({ key: `obstacle[${k}]`, value: null });
  const move = { key: "obstacle[1].at_m", value: [0.1, 0.2, 0.3] };
  const reset = { key: "wash.turns", value: null };
  const one = changed(changed({ text: "a", edits: [] }, [remove(0)]), [reset, move]);
  assert.deepEqual(one.edits, [reset, move, remove(0)]);
  assert.deepEqual(changed(one, [remove(2)]).edits, [reset, move, remove(2), remove(0)]);
});

import assert from "node:assert/strict";
import { test } from "node:test";
import { Keeper, type Kept, type Store } from "../src/edit/history.ts";

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

test("what is kept comes back, for the same file only", () => {
  const tab = new Tab();
  const what: Kept = { steps: steps(3, 5), at: 1, disk: "d", saved: "s" };
  new Keeper(tab, "a.toml").save(what);
  assert.deepEqual(new Keeper(tab, "a.toml").load(), what);
  assert.equal(new Keeper(tab, "b.toml").load(), null);
});

test("of more than there is room for, the steps around the one that stands are kept", () => {
  const tab = new Tab(500_000);
  const keeper = new Keeper(tab, "a");
  keeper.save({ steps: steps(100, 30_000), at: 60, disk: null, saved: null });
  assert.equal(keeper.works, true);
  const found = keeper.load()!;
  assert.equal(found.steps[found.at]!.label, "60");
  assert.ok(found.steps.length > 8 && found.steps.length < 17, String(found.steps.length));
});

test("a tab without room or without a store says so, and does not fail", () => {
  const full = new Keeper(new Tab(10), "a");
  full.save({ steps: steps(2, 100), at: 0, disk: null, saved: null });
  assert.equal(full.works, false);
  assert.equal(full.load(), null);
  const none = new Keeper(null, "a");
  none.save({ steps: steps(1, 1), at: 0, disk: null, saved: null });
  assert.deepEqual([none.works, none.load()], [false, null]);
});

test("what somebody else has stored there is not taken", () => {
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

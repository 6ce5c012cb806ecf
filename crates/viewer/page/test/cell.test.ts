import assert from "node:assert/strict";
import { test } from "node:test";
import type { Centre } from "../src/scene/handles.ts";
import { blamedBodies, isStale, plateState } from "../src/edit/answers.ts";
import { CELL, LOST, newCell, PLAN, PREVIEW, PROOF, turns } from "./fake-cell.ts";

const AT = (x: number): Centre[] => [[x, 0], [0.4, 0]];

test("a scenario is looked at, planned and proved", async () => {
  const { cell, channel } = newCell();
  cell.start();
  assert.equal(cell.state, "previewing");
  const asked = channel.last("proof");
  assert.equal(asked.path, "/cell");
  assert.deepEqual(asked.question, { session: "s", text: "name = \"a\"", edits: [], want: "proof", arm: null, guessed: false });
  asked.drawn();
  assert.equal(cell.state, "planning");
  asked.say(PREVIEW);
  assert.equal(cell.standing.kind, "preview");
  assert.match(cell.standing.words, /plate 2 may not be washable/);
  asked.say(PLAN);
  assert.deepEqual([cell.state, cell.standing], ["proving", { kind: "planned", words: "planned" }]);
  assert.equal(cell.seen.preview, null);
  asked.say(PROOF);
  await asked.end();
  assert.deepEqual([cell.state, cell.standing], ["idle", { kind: "proved", words: "PROVED" }]);
  assert.equal(channel.asked.length, 1);
});

test("a change cancels the running question and ignores its late answers", async () => {
  const { cell, channel } = newCell();
  cell.start();
  const first = channel.last("proof");
  cell.change([{ key: "wash.turns", value: 4 }], "Change wash.turns");
  const second = channel.last("proof");
  assert.equal(first.signal.aborted, true);
  first.drawn("stale");
  first.say(PLAN, PROOF);
  await first.end();
  assert.equal(cell.standing.kind, "preview");
  assert.equal(cell.text, "name = \"a\"");
  assert.deepEqual(second.question.edits, [{ key: "wash.turns", value: 4 }]);
  await second.proved();
  assert.equal(cell.text, "name = \"a\"\nwash.turns = 4");
  assert.equal(cell.standing.kind, "proved");
});

test("an earlier proof is no verdict on a change", async () => {
  const { cell, channel } = newCell();
  cell.start();
  await channel.last("proof").proved();
  cell.change([{ key: "wash.turns", value: 4 }], "x");
  assert.equal(cell.standing.kind, "preview");
  assert.equal(cell.state, "previewing");
});

test("a drag is one step, whatever was asked on its way", async () => {
  const { cell, channel, time } = newCell();
  cell.start();
  await channel.last("proof").proved();
  for (let k = 1; k <= 50; k++) {
    cell.drag(AT((100 + k) / 1000));
    time.pass(16);
    if (k % 3 === 0) {
      channel.last("preview").drawn();
      channel.last("preview").say(PREVIEW);
      await channel.last("preview").end();
    }
  }
  cell.drop("Move plate_0");
  await channel.last("proof").proved();
  assert.equal(cell.history.steps.length, 2);
  assert.match(cell.text, /positions_m = \[\[0\.15,0\],\[0\.4,0\]\]/);
  cell.undo();
  assert.equal(cell.text, "name = \"a\"");
  cell.redo();
  assert.match(cell.text, /0\.15/);
});

test("one preview runs at a time, followed by the newest", async () => {
  const { cell, channel } = newCell();
  cell.start();
  await channel.last("proof").proved();
  cell.drag(AT(0.11));
  cell.drag(AT(0.12));
  cell.drag(AT(0.13));
  assert.equal(channel.count("preview"), 1);
  const first = channel.last("preview");
  assert.equal(first.signal.aborted, false);
  first.drawn();
  first.say(PREVIEW);
  await first.end();
  assert.equal(channel.count("preview"), 2);
  assert.deepEqual(channel.last("preview").question.edits[0]?.value, AT(0.13));
  assert.equal(channel.last("preview").question.session, "sp");
  // The newest was asked: nothing is asked behind it.
  channel.last("preview").say(PREVIEW);
  await channel.last("preview").end();
  assert.equal(channel.count("preview"), 2);
});

test("while the mouse moves a young planning is let finish, an old one is not; a drop waits for none", async () => {
  const { cell, channel, time } = newCell();
  cell.start();
  await channel.last("proof").proved();
  cell.drag(AT(0.11));
  const first = channel.last("proof");
  time.pass(149);
  cell.drag(AT(0.12));
  assert.equal(first.signal.aborted, false);
  assert.equal(channel.last("proof"), first);
  time.pass(1);
  cell.drag(AT(0.13));
  assert.equal(first.signal.aborted, true);
  const second = channel.last("proof");
  time.pass(10);
  cell.drag(AT(0.14));
  second.drawn();
  second.say(PLAN);
  assert.equal(cell.planned?.answers.plan?.headline, "planned");
  assert.equal(cell.standing.kind, "preview", "the plan is of a moment ago");
  cell.drop("Move");
  assert.equal(second.signal.aborted, true);
  assert.deepEqual(channel.last("proof").question.edits[0]?.value, AT(0.14));
  assert.deepEqual(cell.centres, AT(0.14));
});

test("a planning that ends within a drag is followed by one of the newest", async () => {
  const { cell, channel, time } = newCell();
  cell.start();
  await channel.last("proof").proved();
  cell.drag(AT(0.11));
  time.pass(20);
  cell.drag(AT(0.12));
  await channel.last("proof").proved();
  assert.deepEqual(channel.last("proof").question.edits[0]?.value, AT(0.12));
});

test("a drop where the question is already under way does not ask it again", async () => {
  const { cell, channel } = newCell();
  cell.start();
  await channel.last("proof").proved();
  cell.drag(AT(0.2));
  const asked = channel.last("proof");
  asked.drawn();
  cell.drop("Move");
  assert.equal(channel.last("proof"), asked);
  assert.match(cell.text, /0\.2/);
  asked.say(PLAN, PROOF);
  await asked.end();
  assert.equal(cell.standing.kind, "proved");
});

test("a cancelled drag changes nothing", async () => {
  const { cell, channel } = newCell();
  cell.start();
  await channel.last("proof").proved();
  cell.drag(AT(0.3));
  channel.last("preview").drawn();
  cell.cancelDrag();
  assert.deepEqual(cell.centres, AT(0.1));
  assert.equal(cell.history.steps.length, 1);
  await channel.last("proof").proved();
  assert.equal(cell.standing.kind, "proved");
});

test("changes of one thing that follow each other closely are one step; later ones are another", async () => {
  const { cell, channel, time } = newCell();
  cell.start();
  for (const value of [4, 5, 6]) {
    cell.change([{ key: "wash.turns", value }], "Change wash.turns", "wash.turns");
    await channel.last("proof").proved();
    time.pass(900);
  }
  assert.equal(cell.history.steps.length, 2);
  time.pass(200);
  cell.change([{ key: "wash.turns", value: 7 }], "Change wash.turns", "wash.turns");
  cell.change([{ key: "wash.speed_m_s", value: 1 }], "Change wash.speed_m_s", "wash.speed_m_s");
  assert.equal(cell.history.steps.length, 4);
});

test("a burst that ends where it began is no step, and does not eat the one before", async () => {
  const { cell, channel } = newCell();
  cell.start();
  cell.change([{ key: "a", value: 1 }], "a");
  await channel.last("proof").proved();
  cell.change([{ key: "b", value: 1 }], "b", "b");
  cell.change([{ key: "b", value: null }], "b", "b");
  await channel.last("proof").proved();
  assert.equal(cell.history.steps.length, 2);
  cell.change([{ key: "b", value: 2 }], "b", "b");
  await channel.last("proof").proved();
  assert.equal(cell.history.steps.length, 3);
  cell.undo();
  assert.equal(cell.text, "name = \"a\"\na = 1");
});

test("a change that changes nothing is no step", async () => {
  const { cell, channel } = newCell("a = 1");
  cell.start();
  cell.change([{ key: "a", value: 1 }], "a");
  await channel.last("proof").proved();
  assert.equal(cell.history.steps.length, 1);
  cell.setText("a = 1", "text");
  assert.equal(cell.history.steps.length, 1);
});

test("a refusal keeps everything, and a better value of the same key replaces the refused one", async () => {
  const { cell, channel } = newCell();
  cell.start();
  await channel.last("proof").proved();
  const plan = cell.planned?.answers.plan;
  assert.ok(plan);
  cell.change([{ key: "wash.turns", value: 1e9 }], "x");
  channel.last("proof").say({ kind: "refused", words: "too many", key: "wash.turns", line: null, ms: {} });
  await channel.last("proof").end();
  assert.deepEqual([cell.state, cell.standing], ["idle", { kind: "refused", words: "too many" }]);
  assert.equal(cell.text, "name = \"a\"");
  assert.ok(cell.seen.drawn);
  cell.change([{ key: "wash.turns", value: 3 }], "x");
  assert.deepEqual(channel.last("proof").question.edits, [{ key: "wash.turns", value: 3 }]);
  await channel.last("proof").proved();
  cell.undo();
  channel.last("proof").say({ kind: "refused", words: "too many", key: "wash.turns", line: null, ms: {} });
  await channel.last("proof").end();
  cell.undo();
  assert.equal(cell.version.edits.length, 0);
});

test("a lost connection is reported and retried ever more slowly without losing changes", async () => {
  const { cell, channel, time } = newCell();
  cell.start();
  await channel.last("proof").end(LOST);
  assert.equal(cell.standing.kind, "lost");
  assert.notEqual(cell.state, "idle");
  time.pass(299);
  assert.equal(channel.asked.length, 1);
  time.pass(1);
  assert.equal(channel.asked.length, 2);
  assert.equal(cell.standing.kind, "lost", "until somebody answers");
  await channel.last("proof").end(LOST);
  time.pass(599);
  assert.equal(channel.asked.length, 2);
  time.pass(1);
  for (let k = 0; k < 5; k++) {
    await channel.last("proof").end(LOST);
    time.pass(2000);
  }
  assert.equal(channel.asked.length, 8);
  cell.change([{ key: "a", value: 1 }], "a");
  await channel.last("proof").end(LOST);
  cell.change([{ key: "b", value: 2 }], "b");
  assert.deepEqual(channel.last("proof").question.edits, [{ key: "a", value: 1 }, { key: "b", value: 2 }]);
  await channel.last("proof").proved();
  assert.equal(cell.standing.kind, "proved");
  assert.equal(cell.text, "name = \"a\"\na = 1\nb = 2");
  cell.undo();
  assert.deepEqual(channel.last("proof").question.edits, [{ key: "a", value: 1 }]);
});

test("a drag without a connection asks with the next try only", async () => {
  const { cell, channel, time } = newCell();
  cell.start();
  await channel.last("proof").proved();
  cell.drag(AT(0.11));
  await channel.last("proof").end(LOST);
  const before = channel.asked.length;
  for (let k = 0; k < 100; k++) cell.drag(AT(0.12 + 0.001 * k));
  assert.equal(channel.asked.length, before);
  time.pass(300);
  assert.deepEqual(channel.last("proof").question.edits[0]?.value, AT(0.12 + 0.001 * 99));
});

test("an answer that ends before its end is asked for again", async () => {
  const { cell, channel, time } = newCell();
  cell.start();
  channel.last("proof").drawn();
  await channel.last("proof").end();
  assert.equal(cell.standing.kind, "lost");
  time.pass(300);
  await channel.last("proof").proved();
  assert.equal(cell.standing.kind, "proved");
});

test("an infeasible cell shows its reason and other positions of the plates", async () => {
  const { cell, channel } = newCell();
  cell.start();
  const asked = channel.last("proof");
  asked.drawn();
  asked.say({ kind: "unplanned", headline: "INFEASIBLE", reason: "", proved: true, plates: [], ms: {} }, { kind: "place", plate: 1, nearest_m: null, searched_m: 0.2, ms: {} });
  await asked.end();
  assert.deepEqual([cell.state, cell.standing.kind, cell.answers.places.length], ["idle", "unplanned", 1]);
});

test("unknown and invalid lines are ignored", async () => {
  const { cell, channel } = newCell();
  cell.start();
  const asked = channel.last("proof");
  asked.say({ kind: "later" }, [] as object, { kind: 3 } as object, null as unknown as object);
  await asked.proved();
  assert.equal(cell.standing.kind, "proved");
  await turns();
});

test("timings are those of the question", async () => {
  const { cell, channel, time } = newCell();
  time.pass(10);
  cell.start();
  time.pass(5);
  channel.last("proof").drawn();
  time.pass(5);
  channel.last("proof").say(PLAN);
  const [timing] = cell.timings;
  assert.deepEqual([timing!.asked, timing!.scenario, timing!.plan, timing!.proof], [10, 15, 20, null]);
  assert.deepEqual(timing!.ms, { edit: 1, plan: 5 });
});

test("a section is added behind the text and what is not written out yet stays", () => {
  const { cell, channel } = newCell();
  cell.start();
  cell.change([{ key: "seed", value: 2 }], "Change seed");
  cell.append("[[obstacle]]\nname = \"box 1\"\n", "Add box 1");
  const { text, edits } = channel.last("proof").question;
  assert.deepEqual([text, edits], ["name = \"a\"\n\n[[obstacle]]\nname = \"box 1\"\n", [{ key: "seed", value: 2 }]]);
  cell.undo();
  assert.equal(cell.text, "name = \"a\"");
});

test("where a change is refused every plate's row says so, and the reason's body is named", async () => {
  const { cell, channel } = newCell();
  cell.start();
  const post = { name: "post" };
  const drawn = { ...CELL, surroundings: { obstacles: [{ name: "floor" }, post, { name: "post 2" }] }, moves: { bodies: [{ key: null }, { key: "obstacle[0].at_m" }, { key: "obstacle[1].at_m" }] } };
  channel.last("proof").say(drawn, { kind: "unplanned", headline: "INFEASIBLE: link_1 touches post; so", reason: "", proved: true, plates: [], ms: {} });
  await channel.last("proof").end();
  assert.equal(isStale(cell.standing), true);
  assert.deepEqual([0, 1].map((plate) => plateState(cell.answers, plate).word), ["Not planned", "Not planned"]);
  assert.deepEqual(blamedBodies(cell.answers, cell.answers.cell!), [1]);
  const refused = { kind: "refused", words: "no", key: "obstacle[1].size_m", line: null, ms: {} } as const;
  assert.deepEqual(blamedBodies({ ...cell.answers, unplanned: null, refused }, cell.answers.cell!), [2]);
  assert.equal(plateState({ ...cell.answers, unplanned: null, refused }, 0).word, "Not planned");
});

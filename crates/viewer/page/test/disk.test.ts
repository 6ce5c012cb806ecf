import assert from "node:assert/strict";
import { test } from "node:test";
import { Disk, type Conflict } from "../src/edit/disk.ts";
import type { SaveQuestion } from "../src/edit/protocol.ts";
import { FakeChannel, FakeTime, LOST, turns } from "./fake-cell.ts";

function newDisk(): { disk: Disk; channel: FakeChannel; page: { text: string | null; taken: string[]; notices: string[] }; answer: (line: object) => Promise<void> } {
  const channel = new FakeChannel();
  const page = { text: "saved" as string | null, taken: [] as string[], notices: [] as string[] };
  const disk = new Disk(channel, new FakeTime(), "s", { disk: "h1", saved: "saved" }, {
    text: () => page.text,
    take: (text) => {
      page.taken.push(text);
      page.text = text;
    },
    notice: (words) => page.notices.push(words),
    changed: () => undefined,
  });
  const answer = async (line: object): Promise<void> => {
    const asked = channel.asked.at(-1)!;
    asked.say(line);
    await asked.end();
  };
  return { disk, channel, page, answer };
}

const conflictOf = (disk: Disk): Conflict | null => disk.conflict;
const changed = { kind: "disk", disk: "h2", text: "theirs", words: null };

test("a changed file is loaded where there are no unsaved changes", async () => {
  const { disk, page, answer } = newDisk();
  void disk.look();
  await answer(changed);
  assert.deepEqual([page.taken, disk.conflict, disk.known.disk, disk.unsaved], [["theirs"], null, "h2", false]);
  assert.equal(page.notices.length, 1);
});

test("a file that has changed under changes of the page's own is asked about; keeping them asks once", async () => {
  const { disk, channel, page, answer } = newDisk();
  page.text = "mine";
  void disk.look();
  await answer(changed);
  assert.deepEqual([page.taken, disk.conflict?.text, disk.known.disk], [[], "theirs", "h1"]);
  disk.keep();
  assert.equal(disk.conflict, null);
  void disk.look();
  assert.deepEqual(channel.asked.at(-1)!.question, { session: "s", disk: "h2" });
  await answer({ kind: "disk", disk: "h2", text: null, words: null });
  assert.equal(disk.conflict, null);
  void disk.save();
  assert.equal((channel.asked.at(-1)!.question as unknown as SaveQuestion).disk, "h1", "what was kept apart was not read: saving has to ask");
  await answer({ kind: "conflict", disk: "h2", text: "theirs", words: "Another text." });
  assert.equal(conflictOf(disk)?.saving, true);
  void disk.save(true);
  await answer({ kind: "saved", disk: "h3", file: "f", files: [], words: "Saved." });
  assert.deepEqual([disk.conflict, disk.known, disk.unsaved], [null, { disk: "h3", saved: "mine" }, false]);
});

test("an answer under way does not ask again about what was kept apart meanwhile", async () => {
  const { disk, page, answer } = newDisk();
  page.text = "mine";
  void disk.look();
  await answer(changed);
  void disk.look();
  disk.keep();
  await answer(changed);
  assert.equal(conflictOf(disk), null);
  void disk.look();
  await answer({ kind: "disk", disk: "h3", text: "newer", words: null });
  assert.equal(conflictOf(disk)?.text, "newer");
});

test("taking the file's text is a step and leaves nothing unsaved", async () => {
  const { disk, page, answer } = newDisk();
  page.text = "mine";
  void disk.look();
  await answer(changed);
  disk.take();
  assert.deepEqual([page.taken, disk.unsaved, disk.conflict], [["theirs"], false, null]);
});

test("a missing or unreadable file is reported and not loaded", async () => {
  const { disk, page, answer } = newDisk();
  void disk.look();
  await answer({ kind: "disk", disk: null, text: null, words: null });
  assert.deepEqual([page.taken, disk.conflict?.text, /no longer/.test(disk.conflict?.words ?? "")], [[], null, true]);
  disk.take();
  assert.deepEqual(page.taken, []);
});

test("refused, incomplete and unanswered changes are not saved", async () => {
  const { disk, channel, page } = newDisk();
  page.text = null;
  await disk.save();
  assert.equal(channel.asked.length, 0);
  page.text = "mine";
  const saving = disk.save();
  assert.equal(disk.saving, true);
  await channel.asked.at(-1)!.end(LOST);
  await saving;
  assert.deepEqual([disk.saving, disk.unsaved, page.notices.length], [false, true, 2]);
});

test("a check of the file during a save is ignored", async () => {
  const { disk, channel, page } = newDisk();
  page.text = "mine";
  void disk.look();
  const look = channel.asked.at(-1)!;
  void disk.save();
  const save = channel.asked.at(-1)!;
  save.say({ kind: "saved", disk: "h2", file: "f", files: [], words: "" });
  await save.end();
  look.say({ kind: "disk", disk: "h1b", text: "old", words: null });
  await look.end();
  await turns();
  assert.deepEqual([disk.conflict, page.taken, disk.known.disk], [null, [], "h2"]);
});

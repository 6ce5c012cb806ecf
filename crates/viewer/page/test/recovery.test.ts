/** The way on after a stop, as it is asked for and shown. */
import assert from "node:assert/strict";
import { test } from "node:test";
import { ChannelError, type Channel } from "../src/edit/channel.ts";
import { readJoints, RecoveryAsker } from "../src/edit/recovery.ts";

/** A channel whose answers a test gives. */
function channel() {
  const asked: { path: string; question: object; tell: (line: unknown) => void; signal: AbortSignal; fail: (error: unknown) => void }[] = [];
  const ask: Channel["ask"] = (path, question, tell, signal) =>
    new Promise((_, fail) => asked.push({ path, question, tell, signal, fail }));
  return { asked, channel: { ask } as unknown as Channel };
}

test("joints are six numbers, or none", () => {
  assert.deepEqual(readJoints(" 1, -2.5;3° 4 5 6 "), [1, -2.5, 3, 4, 5, 6]);
  assert.equal(readJoints("  "), null);
  for (const text of ["1 2 3", "1 2 3 4 5 x", "1 2 3 4 5 6 7", "1 2 3 4 5 Infinity"]) assert.equal(readJoints(text), "not six");
});

test("a recovery is shown until it is cleared or the cell changes", () => {
  const { asked, channel: of } = channel();
  let changes = 0;
  const recovery = new RecoveryAsker(of, "session", () => changes++);
  recovery.ask("cell", 3.5, null);
  assert.deepEqual([asked[0]!.path, asked[0]!.question], ["/recover", { session: "sessionr", text: "cell", stopped_s: 3.5, at_deg: null }]);
  assert.equal(recovery.words, "Planning and proving the way home …");
  const view = { format: "platewash-view/2" };
  asked[0]!.tell({ kind: "recovery", proved: true, stop: "at 3.50 s", rest: "REST", view, ms: {} });
  assert.equal(recovery.view, view);
  assert.equal(recovery.words, "Stopped at 3.50 s. Shown: the motion home. Then the rest: REST.");
  recovery.follow("cell", false);
  assert.equal(recovery.view, view);
  recovery.follow("another cell", false);
  assert.deepEqual([recovery.view, recovery.words, asked[0]!.signal.aborted], [null, null, true]);
  assert.equal(changes, 3);
});

test("what is refused is said, and an answer that comes late is not shown", async () => {
  const { asked, channel: of } = channel();
  const recovery = new RecoveryAsker(of, "session", () => undefined);
  recovery.ask("cell", null, [1, 2, 3, 4, 5, 6]);
  asked[0]!.tell({ kind: "refused", words: "bodies touch", key: null, line: null, ms: {} });
  assert.equal(recovery.words, "bodies touch");
  recovery.ask("cell", 1, null);
  asked[0]!.tell({ kind: "recovery", proved: true, stop: "", rest: null, view: {}, ms: {} });
  assert.equal(recovery.view, null);
  asked[1]!.fail(new ChannelError("lost", "nobody answers"));
  await new Promise((resolve) => setTimeout(resolve));
  assert.equal(recovery.words, "nobody answers");
});

import assert from "node:assert/strict";
import { test } from "node:test";
import { backOff, ChannelError, FrameChannel, HttpChannel, Lines, type FrameWindow } from "../src/edit/channel.ts";
import { turns } from "./fake-cell.ts";

function linesOf(bytes: Uint8Array, cuts: readonly number[]): unknown[] {
  const heard: unknown[] = [];
  const lines = new Lines((line) => heard.push(line));
  let from = 0;
  for (const cut of [...cuts, bytes.length]) {
    lines.push(bytes.subarray(from, cut));
    from = cut;
  }
  lines.end();
  return heard;
}

test("lines are the same wherever bytes are cut, within characters too", () => {
  const said = [{ words: "Größe \u202f 🍽️ ünïcode" }, { n: 1 }, "x", [1, 2]];
  const bytes = new TextEncoder().encode(`${said.map((one) => JSON.stringify(one)).join("\n")}\n`);
  for (let a = 0; a <= bytes.length; a++) assert.deepEqual(linesOf(bytes, [a]), said, `cut at ${a}`);
  assert.deepEqual(linesOf(bytes, Array.from({ length: bytes.length }, (_, k) => k)), said);
});

test("blank lines say nothing, a last line needs no end, and what is no JSON is an error", () => {
  assert.deepEqual(linesOf(new TextEncoder().encode("\n\r\n1\n\n2"), []), [1, 2]);
  assert.throws(() => linesOf(new TextEncoder().encode("1\n{\"a\":\n2\n"), []), SyntaxError);
});

test("waits grow from 0.3 s to 2 s", () => {
  assert.deepEqual([0, 1, 2, 3, 9, 1e9].map(backOff), [300, 600, 1200, 2000, 2000, 2000]);
});

type Fetched = { path: string; token: string | null };

function http(answers: Record<string, (token: string | null) => Response>, token = (): string => "old"): { channel: HttpChannel; fetched: Fetched[]; hellos: unknown[] } {
  const fetched: Fetched[] = [];
  const hellos: unknown[] = [];
  const how = (async (path: string, init: RequestInit) => {
    const sent = new Headers(init.headers).get("X-Platewash-Token");
    assert.equal(new Headers(init.headers).get("Content-Type"), "application/json");
    assert.equal(init.method, "POST");
    fetched.push({ path, token: sent });
    const answer = answers[path]?.(sent);
    if (answer === undefined) throw new TypeError("network");
    return answer;
  }) as typeof fetch;
  return { channel: new HttpChannel(token, (hello) => hellos.push(hello), how), fetched, hellos };
}

const HELLO = { kind: "hello", format: "platewash-edit/1", file: "f", disk: null };

test("a server that was started later is greeted once its token is there", async () => {
  let token = "old";
  const known = (sent: string | null, words: string): Response => (sent === "new" ? new Response(words) : new Response("gone", { status: 403 }));
  const { channel, fetched, hellos } = http({
    "/cell": (sent) => {
      const answer = known(sent, "1\n2\n");
      token = "new";
      return answer;
    },
    "/hello": (sent) => known(sent, `${JSON.stringify(HELLO)}\n`),
  }, () => token);
  const heard: unknown[] = [];
  await channel.ask("/cell", {}, (line) => heard.push(line), new AbortController().signal);
  assert.deepEqual(heard, [1, 2]);
  assert.deepEqual(fetched.map(({ path }) => path), ["/cell", "/hello", "/cell"]);
  assert.deepEqual(hellos, [HELLO]);
  await channel.ask("/cell", {}, () => undefined, new AbortController().signal);
  assert.equal(fetched.length, 4);
});

async function lossOf(channel: HttpChannel): Promise<string> {
  return channel.ask("/cell", {}, () => undefined, new AbortController().signal).then(() => "none", (error: unknown) => (error instanceof ChannelError ? error.loss : String(error)));
}

test("the causes of a failed question are distinguished", async () => {
  assert.equal(await lossOf(http({}).channel), "lost");
  assert.equal(await lossOf(http({ "/cell": () => new Response("", { status: 503 }) }).channel), "busy");
  assert.equal(await lossOf(http({ "/cell": () => new Response("too large", { status: 413 }) }).channel), "refused");
  assert.equal(await lossOf(http({ "/cell": () => new Response("no json\n") }).channel), "lost");
  const foreign = http({ "/cell": () => new Response("", { status: 403 }), "/hello": () => new Response("{}\n") });
  assert.equal(await lossOf(foreign.channel), "refused");
  const unknown = http({ "/cell": () => new Response("", { status: 403 }), "/hello": () => new Response("", { status: 403 }) });
  assert.equal(await lossOf(unknown.channel), "lost");
  const never = http({ "/cell": () => new Response("", { status: 403 }), "/hello": () => new Response(JSON.stringify(HELLO)) });
  assert.equal(await lossOf(never.channel), "refused");
  assert.equal(never.fetched.length, 3);
});

function frame(): { channel: FrameChannel; sent: Record<string, unknown>[]; hear: (data: unknown, source?: unknown) => void; taken: string[] } {
  const sent: Record<string, unknown>[] = [];
  const taken: string[] = [];
  const listeners: ((event: { source: unknown; data: unknown }) => void)[] = [];
  const parent: FrameWindow["parent"] = { postMessage: (message) => sent.push(message as Record<string, unknown>) };
  const channel = new FrameChannel({ parent, addEventListener: (_, listener) => listeners.push(listener) }, (text) => taken.push(text));
  return { channel, sent, taken, hear: (data, source = parent) => listeners.forEach((listener) => listener({ source, data })) };
}

test("a frame asks its parent and ignores other senders", async () => {
  const { channel, sent, hear, taken } = frame();
  const heard: unknown[] = [];
  let ended = false;
  void channel.ask("/cell", { text: "a" }, (line) => heard.push(line), new AbortController().signal).then(() => (ended = true));
  assert.deepEqual(sent, [{ platewash: 1, path: "/cell", question: { text: "a" } }]);
  hear({ platewash: 1, line: { kind: "x" } });
  hear({ platewash: 1, line: "{\"kind\":\"y\"}" });
  hear({ platewash: 1, line: { kind: "foreign" } }, {});
  hear({ platewash: 2, line: { kind: "other" } });
  hear(null);
  hear("text");
  hear({ platewash: 1, end: true }, {});
  await turns();
  assert.equal(ended, false);
  hear({ platewash: 1, end: true });
  await turns();
  assert.deepEqual([heard, ended], [[{ kind: "x" }, { kind: "y" }], true]);
  hear({ platewash: "take", text: "new" });
  hear({ platewash: "take", text: "foreign" }, {});
  assert.deepEqual(taken, ["new"]);
});

test("a frame tells its parent which questions it cancels", async () => {
  const { channel, sent, hear } = frame();
  const abort = new AbortController();
  const heard: unknown[] = [];
  const asked = channel.ask("/cell", {}, (line) => heard.push(line), abort.signal);
  abort.abort();
  await asked;
  assert.deepEqual(sent.at(-1), { platewash: 1, abort: true });
  hear({ platewash: 1, line: { kind: "late" } });
  assert.deepEqual(heard, []);
});

import assert from "node:assert/strict";
import { test } from "node:test";
import { Live, parseEnd, parseSamples, parseState, type EventStream, type LivePhase } from "../src/live.ts";
import { LIVE_COLUMNS, Recording } from "../src/recording.ts";
import type { Execution } from "../src/view.ts";

class Stream implements EventStream {
  readyState = 0;
  readonly #listeners = new Map<string, ((event: { data?: unknown }) => void)[]>();

  addEventListener(type: string, listener: (event: { data?: unknown }) => void): void {
    this.#listeners.set(type, [...(this.#listeners.get(type) ?? []), listener]);
  }

  close(): void {
    this.readyState = 2;
  }

  say(type: string, data?: unknown): void {
    for (const listener of this.#listeners.get(type) ?? []) listener(typeof data === "string" ? { data } : { data: JSON.stringify(data) });
  }
}

function watched(): { live: Live; streams: Stream[]; heard: string[]; timers: [() => void, number][] } {
  const streams: Stream[] = [];
  const heard: string[] = [];
  const timers: [() => void, number][] = [];
  const live = new Live(
    "events",
    {
      phase: (phase: LivePhase) => heard.push(phase),
      samples: (rows) => heard.push(`${rows.length} samples`),
      done: (end) => heard.push(end.headline),
    },
    {
      open: () => {
        const stream = new Stream();
        streams.push(stream);
        return stream;
      },
      later: (callback, after) => timers.push([callback, after]),
    },
  );
  live.start();
  return { live, streams, heard, timers };
}

const row = (t: number): number[] => [t, ...new Array<number>(LIVE_COLUMNS - 1).fill(t)];

test("a run is heard from its beginning to its end", () => {
  const { streams: [stream], heard } = watched();
  stream!.say("open");
  stream!.say("state", { state: "waiting" });
  stream!.say("state", { state: "running" });
  stream!.say("samples", { samples: [row(0), row(0.02)] });
  stream!.say("done", { headline: "WASHED", washed: true });
  assert.deepEqual(heard, ["waiting", "running", "2 samples", "done", "WASHED"]);
  assert.equal(stream!.readyState, 2);
  stream!.say("samples", { samples: [row(1)] });
  assert.equal(heard.length, 5);
});

test("a lost connection shows, and comes back to what it was", () => {
  const { live, streams: [stream], heard } = watched();
  stream!.say("state", { state: "running" });
  stream!.say("error");
  assert.equal(live.phase, "reconnecting");
  stream!.say("open");
  assert.deepEqual(heard, ["running", "reconnecting", "running"]);
});

test("where the browser gives up, a new stream is opened, later and later", () => {
  const { streams, timers } = watched();
  for (let k = 0; k < 6; k++) {
    streams[k]!.readyState = 2;
    streams[k]!.say("error");
    timers[k]![0]();
    assert.equal(streams.length, k + 2);
  }
  assert.deepEqual(timers.map(([, after]) => after), [500, 1000, 2000, 4000, 5000, 5000]);
  streams[6]!.say("open");
  streams[6]!.readyState = 2;
  streams[6]!.say("error");
  assert.equal(timers[6]![1], 500);
});

test("invalid events are ignored", () => {
  for (const data of ["", "{", "null", "3", undefined, '{"state":"flying"}', '{"state":7}']) assert.equal(parseState(data), null);
  for (const data of ["", "[]", '{"samples":7}', '{"samples":[["a"],7,null]}']) assert.deepEqual(parseSamples(data), []);
  for (const data of ["", "{}", '{"headline":7}']) assert.equal(parseEnd(data), null);
  assert.deepEqual(parseEnd('{"headline":"x"}'), { headline: "x", washed: null });
});

const EMPTY: Execution = {
  source: "live",
  law: null,
  headline: null,
  washed: null,
  t_s: { shape: [0], f64: "" },
  q_rad: { shape: [0, 6], f64: "" },
  qd_rad_s: { shape: [0, 6], f64: "" },
  qdd_rad_s2: null,
  torque_n_m: null,
  torque_limit_n_m: null,
  error_m: { shape: [0], f64: "" },
  coverage: [],
};

test("repeated samples count once and invalid ones are left out", () => {
  const recording = new Recording(EMPTY);
  recording.append([row(0), row(0.5)]);
  assert.equal(recording.count, 2);
  recording.append([row(0), row(0.5), row(1), [1, 2], row(Number.NaN)]);
  assert.equal(recording.count, 3);
  assert.equal(recording.end, 1);
  assert.deepEqual([...recording.times], [0, 0.5, 1]);
  assert.equal(recording.positions.length, 18);
});

test("between samples the joints are interpolated, outside they rest", () => {
  const recording = new Recording(EMPTY);
  const q = new Float64Array(6);
  assert.equal(recording.positionAt(0, q), false);
  assert.equal(recording.sampleAt(0), -1);
  recording.append(Array.from({ length: 200 }, (_, k) => row(k / 10)));
  for (const [t, expected] of [[-1, 0], [0.25, 0.25], [7.77, 7.77], [19.9, 19.9], [99, 19.9]] as const) {
    assert.equal(recording.positionAt(t, q), true);
    assert.ok(Math.abs(q[5]! - expected) < 1e-12);
  }
  assert.equal(recording.sampleAt(0.25), 2);
  assert.ok(Math.abs(recording.errorOf(2) - 0.2) < 1e-15);
});

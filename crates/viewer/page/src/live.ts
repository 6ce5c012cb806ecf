/** A live run's events (see the end of `view.ts`), and how its samples get into the player and the scene. */
import { AXES } from "./motion.ts";
import type { Player } from "./player.ts";
import type { LiveEnd, LiveState, SamplesEvent } from "./view.ts";

/** How it stands: `connecting` before the first word of the server, `reconnecting` after a connection that was lost. */
export type LivePhase = "connecting" | "waiting" | "running" | "reconnecting" | "done";

export interface LiveListener {
  phase(phase: LivePhase): void;
  samples(rows: number[][]): void;
  done(end: LiveEnd): void;
}

/** What this needs of a browser's `EventSource`. */
export interface EventStream {
  addEventListener(type: string, listener: (event: { data?: unknown }) => void): void;
  close(): void;
  /** 2: closed for good, so that it does not reconnect by itself. */
  readonly readyState: number;
}

export interface LiveSettings {
  open: (url: string) => EventStream;
  /** Calls back after a time [ms]. */
  later: (callback: () => void, after: number) => void;
}

const CLOSED = 2;
const FIRST_WAIT_MS = 500;
const LONGEST_WAIT_MS = 5000;

function parse(data: unknown): Record<string, unknown> | null {
  if (typeof data !== "string") return null;
  try {
    const value: unknown = JSON.parse(data);
    return typeof value === "object" && value !== null ? (value as Record<string, unknown>) : null;
  } catch {
    return null;
  }
}

/** A `state` event; null for what is none. */
export function parseState(data: unknown): LiveState | null {
  const state = parse(data)?.["state"];
  return state === "waiting" || state === "running" || state === "done" ? state : null;
}

/** The rows of a `samples` event: only those that are lists of numbers. */
export function parseSamples(data: unknown): SamplesEvent["samples"] {
  const rows = parse(data)?.["samples"];
  if (!Array.isArray(rows)) return [];
  return rows.filter((row): row is number[] => Array.isArray(row) && row.every((value) => typeof value === "number"));
}

/** A `done` event; null for what is none. */
export function parseEnd(data: unknown): LiveEnd | null {
  const end = parse(data);
  if (end === null || typeof end["headline"] !== "string") return null;
  return { headline: end["headline"], washed: typeof end["washed"] === "boolean" ? end["washed"] : null };
}

/**
 * Listens to a live run until it is done. Streams reconnect by themselves and say what they had last; where the browser has given
 * up, a new one is opened, which hears everything again: `samples` may come twice.
 */
export class Live {
  readonly #url: string;
  readonly #listener: LiveListener;
  readonly #settings: LiveSettings;
  #stream: EventStream | null = null;
  #wait = FIRST_WAIT_MS;
  #phase: LivePhase = "connecting";
  #state: LivePhase = "connecting";

  constructor(url: string, listener: LiveListener, settings: LiveSettings) {
    this.#url = url;
    this.#listener = listener;
    this.#settings = settings;
  }

  get phase(): LivePhase {
    return this.#phase;
  }

  start(): void {
    const stream = this.#settings.open(this.#url);
    this.#stream = stream;
    const ofThis = (handle: (data: unknown) => void) => (event: { data?: unknown }) => {
      if (this.#stream === stream && this.#phase !== "done") handle(event.data);
    };
    stream.addEventListener("open", ofThis(() => {
      this.#wait = FIRST_WAIT_MS;
      this.#say(this.#state);
    }));
    stream.addEventListener("state", ofThis((data) => {
      const state = parseState(data);
      // The run's end is told by `done`, which has its verdict.
      if (state !== null && state !== "done") this.#arrive(state);
    }));
    stream.addEventListener("samples", ofThis((data) => {
      const rows = parseSamples(data);
      if (rows.length === 0) return;
      this.#arrive("running");
      this.#listener.samples(rows);
    }));
    stream.addEventListener("done", ofThis((data) => {
      const end = parseEnd(data);
      if (end === null) return;
      this.stop();
      this.#say("done");
      this.#listener.done(end);
    }));
    stream.addEventListener("error", ofThis(() => {
      this.#say("reconnecting");
      if (stream.readyState === CLOSED) this.#again(stream);
    }));
  }

  stop(): void {
    this.#stream?.close();
    this.#stream = null;
  }

  #again(stream: EventStream): void {
    stream.close();
    this.#stream = null;
    this.#settings.later(() => {
      if (this.#phase === "reconnecting" && this.#stream === null) this.start();
    }, this.#wait);
    this.#wait = Math.min(2 * this.#wait, LONGEST_WAIT_MS);
  }

  #arrive(phase: LivePhase): void {
    this.#state = phase;
    this.#say(phase);
  }

  #say(phase: LivePhase): void {
    if (phase === this.#phase) return;
    this.#phase = phase;
    this.#listener.phase(phase);
  }
}

/** Least time between two changes of the path that is drawn [ms]. */
const DRAWN_MS = 200;

export interface FeedListener {
  changed(): void;
  /** New samples to draw: times [s] and joints [rad], six a time. */
  draw(times: Float64Array, positions: Float64Array): void;
  done(end: LiveEnd): void;
}

/** Takes a live run's samples to the player and the scene. */
export class Feed {
  readonly #player: Player;
  readonly #listener: FeedListener;
  #drawn = 0;
  #at = Number.NEGATIVE_INFINITY;

  constructor(player: Player, listener: FeedListener) {
    this.#player = player;
    this.#listener = listener;
  }

  /** Listens to the run; nothing where the page shows none. */
  start(): void {
    const { view, recording } = this.#player;
    if (view.live === null || recording === null) return;
    const live = new Live(
      view.live,
      {
        phase: (phase) => {
          this.#player.phase = phase;
          this.#listener.changed();
        },
        samples: (rows) => recording.append(rows),
        done: (end) => this.#listener.done(end),
      },
      {
        open: (url) => new EventSource(url),
        later: (callback, after) => window.setTimeout(callback, after),
      },
    );
    live.start();
    addEventListener("pagehide", () => live.stop());
  }

  /** Hands on what has arrived, now and then. */
  flush(now: number): void {
    const recording = this.#player.recording;
    if (recording === null || recording.count === this.#drawn) return;
    if (now >= this.#at && now - this.#at < DRAWN_MS) return;
    this.#at = now;
    this.#listener.draw(recording.times.subarray(this.#drawn), recording.positions.subarray(AXES * this.#drawn));
    this.#drawn = recording.count;
  }
}

/** A live run's events: see the end of `view.ts`. */
import type { LiveEnd, LiveSamples, LiveState } from "./view.ts";

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
export function parseState(data: unknown): LiveState["state"] | null {
  const state = parse(data)?.["state"];
  return state === "waiting" || state === "running" || state === "done" ? state : null;
}

/** The rows of a `samples` event: only those that are lists of numbers. */
export function parseSamples(data: unknown): LiveSamples["samples"] {
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

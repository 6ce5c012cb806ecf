/** What is asked about a scenario that changes: guesses while something moves, plan and proof of what counts, again after a loss. */
import { activity, isLine, isWhole, NOTHING, Seen, withLine, type Activity, type Answers } from "./answers.ts";
import { backOff, ChannelError, type Channel } from "./channel.ts";
import { sameVersion, type Version } from "./history.ts";
import type { CellLine, CellQuestion, Milliseconds } from "./protocol.ts";

/** The clock and timers, so that tests can hold them. */
export interface Time {
  /** [ms] */
  now(): number;
  /** Calls back after a time [ms]; the answer takes that back. */
  later(callback: () => void, after_ms: number): () => void;
}

export const BROWSER_TIME: Time = {
  now: () => performance.now(),
  later: (callback, after_ms) => {
    const timer = setTimeout(callback, after_ms);
    return () => clearTimeout(timer);
  },
};

/** When a question was asked, answered and drawn: times are `performance.now()` [ms]; null for what has not come. */
export interface Timing {
  want: "preview" | "proof";
  asked: number;
  scenario: number | null;
  preview: number | null;
  plan: number | null;
  proof: number | null;
  drawnPlan: number | null;
  drawnProof: number | null;
  /** What steps took where they were done. */
  ms: Milliseconds;
}

/** Questions that are remembered. */
const KEPT = 200;

export interface Asked {
  /** What was asked about; written out once whoever plans has done so. */
  version: Version;
  answers: Answers;
  readonly timing: Timing;
  /** Whether more is to come. */
  running: boolean;
}

export interface LaneSettings {
  channel: Channel;
  time: Time;
  /** The last questions. */
  timings: Timing[];
  session: string;
  want: CellQuestion["want"];
  /** Id of the arm that the page has. */
  arm: () => string | null;
  /** Whether the page shows a guess. */
  guessed: () => boolean;
  /** A line of the question that is asked has come. */
  line(asked: Asked, line: CellLine): void;
  /** It was answered to its end, or will not be. */
  end(asked: Asked, error: ChannelError | null): void;
}

/** Questions of one kind: one at a time, the newest. */
export class Lane {
  readonly #settings: LaneSettings;
  #asked: Asked | null = null;
  #abort: AbortController | null = null;

  constructor(settings: LaneSettings) {
    this.#settings = settings;
  }

  /** The question that counts. */
  get asked(): Asked | null {
    return this.#asked;
  }

  get running(): boolean {
    return this.#asked?.running ?? false;
  }

  /** For how long the question has run [ms]. */
  get age(): number {
    return this.#asked === null ? 0 : this.#settings.time.now() - this.#asked.timing.asked;
  }

  /** Asks; what was asked before no longer counts, and is given up where it runs. */
  ask(version: Version): void {
    this.stop();
    const { channel, session, want, timings, time } = this.#settings;
    const open = { scenario: null, preview: null, plan: null, proof: null, drawnPlan: null, drawnProof: null };
    const timing: Timing = { ...open, want, asked: time.now(), ms: {} };
    const asked: Asked = { version, answers: NOTHING, timing, running: true };
    timings.push(timing);
    if (timings.length > KEPT) timings.shift();
    const abort = new AbortController();
    this.#asked = asked;
    this.#abort = abort;
    const { text, edits } = version;
    const question: CellQuestion = { session, text, edits: [...edits], want, arm: this.#settings.arm(), guessed: this.#settings.guessed() };
    channel.ask("/cell", question, (line) => this.#hear(asked, line), abort.signal).then(
      () => this.#end(asked, null),
      (error: unknown) => this.#end(asked, error instanceof ChannelError ? error : new ChannelError("lost", "The answer cannot be read.")),
    );
  }

  /** Nothing is asked any more. */
  stop(): void {
    this.#asked = null;
    this.#abort?.abort();
    this.#abort = null;
  }

  #hear(asked: Asked, line: unknown): void {
    if (asked !== this.#asked || !asked.running || !isLine(line) || line.kind === "superseded") return;
    asked.answers = withLine(asked.answers, line);
    const { timing } = asked;
    const { kind } = line;
    if (kind === "scenario" || kind === "preview" || kind === "plan" || kind === "proof") timing[kind] ??= this.#settings.time.now();
    if ("ms" in line) Object.assign(timing.ms, line.ms);
    this.#settings.line(asked, line);
  }

  #end(asked: Asked, error: ChannelError | null): void {
    if (asked !== this.#asked || !asked.running) return;
    asked.running = false;
    this.#abort = null;
    const whole = isWhole(asked.answers, this.#settings.want);
    this.#settings.end(asked, whole ? null : (error ?? new ChannelError("lost", "The answer ended before its end.")));
  }
}

/** While the mouse moves, a planning younger than this is let finish, so that plans appear [ms]. */
export const YOUNG_MS = 150;

export interface AskerSettings {
  channel: Channel;
  time: Time;
  /** Of this load of the page: letters and digits. */
  session: string;
}

/** Who has the scenario. */
export interface Asking {
  /** What counts now. */
  version(): Version;
  /** Whether it is on its way to another. */
  moving(): boolean;
  /** What counts was written out and drawn, as far as there are answers. */
  answered(asked: Asked): void;
  changed(): void;
}

export class Asker {
  readonly timings: Timing[] = [];
  readonly seen = new Seen();
  readonly #time: Time;
  readonly #asking: Asking;
  readonly #looking: Lane;
  readonly #planning: Lane;
  #lost: ChannelError | null = null;
  #tries = 0;
  #cancelRetry: (() => void) | null = null;

  constructor({ channel, time, session }: AskerSettings, asking: Asking) {
    this.#time = time;
    this.#asking = asking;
    const line = (asked: Asked, said: CellLine): void => this.#hear(asked, said);
    const common = { channel, time, timings: this.timings, arm: () => this.seen.arm?.id ?? null, line };
    this.#looking = new Lane({ ...common, session: `${session}p`, want: "preview", guessed: () => false, end: () => this.#looked() });
    this.#planning = new Lane({ ...common, session, want: "proof", guessed: () => this.seen.preview !== null, end: (asked, error) => this.#planned(asked, error) });
  }

  /** The question of plan and proof that was asked last. */
  get planned(): Asked | null {
    return this.#planning.asked;
  }

  /** Why nobody answers; null where somebody does. */
  get lost(): ChannelError | null {
    return this.#lost;
  }

  get state(): Activity {
    if (this.#planning.running) return activity(this.#planning.asked?.answers ?? NOTHING);
    return this.#lost !== null || this.#looking.running || this.#asking.moving() ? "previewing" : "idle";
  }

  /** What was answered about what counts; of what moves, what was guessed a moment ago. */
  get answers(): Answers {
    const answers = this.#current?.answers ?? NOTHING;
    const guessed = this.#asking.moving() && answers.preview === null;
    return guessed ? { ...answers, cell: this.seen.drawn, preview: this.seen.preview } : answers;
  }

  /** Asks for plan and proof of what counts, unless that is what was asked. */
  ensure(): void {
    const asked = this.#planning.asked;
    if (asked === null || !this.#counts(asked) || (!asked.running && this.#lost !== null)) return this.#askPlan();
    this.seen.restore(asked.answers);
    if (!this.#asking.moving()) this.#asking.answered(asked);
  }

  /** What counts has moved on. Without a connection the next try asks for the newest. */
  moved(): void {
    if (this.#lost !== null) return;
    this.#look();
    if (!this.#planning.running || this.#planning.age >= YOUNG_MS) this.ensure();
  }

  /** It moves no longer. */
  stopLooking(): void {
    this.#looking.stop();
  }

  get #current(): Asked | null {
    const asked = [this.#planning.asked, this.#looking.asked].find((one) => one !== null && this.#counts(one));
    return asked ?? (this.#asking.moving() ? this.#looking.asked : null);
  }

  #counts(asked: Asked): boolean {
    return sameVersion(asked.version, this.#asking.version());
  }

  #askPlan(): void {
    this.#cancelRetry?.();
    this.#cancelRetry = null;
    this.#planning.ask(this.#asking.version());
  }

  /** Asks for a guess, unless one is on its way: then the newest is asked for behind it. */
  #look(): void {
    if (!this.#looking.running) this.#looking.ask(this.#asking.version());
  }

  #looked(): void {
    const asked = this.#looking.asked;
    if (this.#asking.moving() && asked !== null && !this.#counts(asked) && this.#lost === null) this.#look();
    this.#asking.changed();
  }

  #planned(asked: Asked, error: ChannelError | null): void {
    if (error !== null && error.loss === "refused") asked.answers = { ...asked.answers, failed: error.message };
    else if (error !== null) return this.#again(error);
    this.#found();
    if (this.#asking.moving()) this.ensure();
    this.#asking.changed();
  }

  #again(error: ChannelError): void {
    this.#lost = error;
    this.#cancelRetry = this.#time.later(() => this.#askPlan(), backOff(this.#tries++));
    this.#asking.changed();
  }

  /** Somebody answers. */
  #found(): void {
    this.#lost = null;
    this.#tries = 0;
  }

  #hear(asked: Asked, line: CellLine): void {
    this.#found();
    const counts = this.#counts(asked);
    this.seen.hear(line, counts);
    if (counts && !this.#asking.moving()) this.#asking.answered(asked);
    this.#asking.changed();
  }
}

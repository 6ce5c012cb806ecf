/** What is asked about a scenario that changes: guesses while something moves, plan and proof of what counts, again after a loss. */
import { NOTHING, type Answers } from "./answers.ts";
import { backOff, type Channel, type ChannelError } from "./channel.ts";
import { Lane, type Asked, type LaneListener } from "./lane.ts";
import type { CellLine } from "./protocol.ts";
import { Seen } from "./seen.ts";
import { activity, type Activity } from "./standing.ts";
import type { Time } from "./time.ts";
import { Timings } from "./timings.ts";
import { sameVersion, type Version } from "./version.ts";

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
  readonly timings = new Timings();
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
    const common = { channel, time, timings: this.timings, arm: () => this.seen.arm?.id ?? null };
    const line: LaneListener["line"] = (asked, said) => this.#hear(asked, said);
    this.#looking = new Lane({ ...common, session: `${session}p`, want: "preview" }, { line, end: () => this.#looked() });
    this.#planning = new Lane({ ...common, session, want: "proof" }, { line, end: (asked, error) => this.#planned(asked, error) });
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

/** Questions of one kind: one at a time, the newest. */
import { NOTHING, isLine, isWhole, withLine, type Answers } from "./answers.ts";
import { ChannelError, type Channel } from "./channel.ts";
import type { CellLine, CellQuestion } from "./protocol.ts";
import type { Time } from "./time.ts";
import { arrived, type Timing, type Timings } from "./timings.ts";
import type { Version } from "./version.ts";

export interface Asked {
  /** What was asked about; written out once whoever plans has done so. */
  version: Version;
  answers: Answers;
  readonly timing: Timing;
  /** Whether more is to come. */
  running: boolean;
}

export interface LaneListener {
  /** A line of the question that is asked has come. */
  line(asked: Asked, line: CellLine): void;
  /** It was answered to its end, or will not be. */
  end(asked: Asked, error: ChannelError | null): void;
}

export interface LaneSettings {
  channel: Channel;
  time: Time;
  timings: Timings;
  session: string;
  want: CellQuestion["want"];
  /** Id of the arm that the page has. */
  arm: () => string | null;
}

export class Lane {
  readonly #settings: LaneSettings;
  readonly #listener: LaneListener;
  #asked: Asked | null = null;
  #abort: AbortController | null = null;

  constructor(settings: LaneSettings, listener: LaneListener) {
    this.#settings = settings;
    this.#listener = listener;
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
    const asked: Asked = { version, answers: NOTHING, timing: timings.begin(want, time.now()), running: true };
    const abort = new AbortController();
    this.#asked = asked;
    this.#abort = abort;
    const { text, edits } = version;
    const question: CellQuestion = { session, text, edits: [...edits], want, arm: this.#settings.arm() };
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
    arrived(asked.timing, line.kind, "ms" in line ? line.ms : undefined, this.#settings.time.now());
    this.#listener.line(asked, line);
  }

  #end(asked: Asked, error: ChannelError | null): void {
    if (asked !== this.#asked || !asked.running) return;
    asked.running = false;
    this.#abort = null;
    const whole = isWhole(asked.answers, this.#settings.want);
    this.#listener.end(asked, whole ? null : (error ?? new ChannelError("lost", "The answer ended before its end.")));
  }
}

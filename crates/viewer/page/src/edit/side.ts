/** A question about the cell beside its plan: asked on request, answered in words and more, given up where the cell changes. */
import { ChannelError, type Channel } from "./channel.ts";

interface Question {
  session: string;
  text: string;
}

export abstract class SideAsker<Q extends Question, Line> {
  readonly #channel: Channel;
  readonly #session: string;
  readonly #changed: () => void;
  #abort: AbortController | null = null;
  #words: string | null = null;
  /** The scenario that it is of. */
  #text = "";

  /** `session`: of this kind of question alone. */
  constructor(channel: Channel, session: string, changed: () => void) {
    this.#channel = channel;
    this.#session = session;
    this.#changed = changed;
  }

  /** What is to be said about the answer that is shown; null for none. */
  get words(): string | null {
    return this.#words;
  }

  /** Shows none. */
  clear(): void {
    if (this.#abort === null) return;
    this.#abort.abort();
    this.#abort = null;
    this.#words = null;
    this.forget();
    this.#changed();
  }

  /** Gives it up where the cell is another by now. */
  follow(text: string, changing: boolean): void {
    if (this.#abort !== null && (changing || text !== this.#text)) this.clear();
  }

  /** Begins with the scenario `text`; a question before is given up. */
  protected begin(text: string, words: string): AbortController {
    this.#abort?.abort();
    this.#abort = new AbortController();
    this.#text = text;
    this.say(words);
    return this.#abort;
  }

  /** Asks about the scenario; `unread` are the words where the answer cannot be read. */
  protected question(path: string, text: string, rest: Omit<Q, keyof Question>, words: string, unread: string): void {
    const abort = this.begin(text, words);
    const hear = (line: unknown): void => {
      if (this.#abort === abort && line !== null) this.hear(line as Line);
    };
    this.#channel.ask(path, { session: this.#session, text, ...rest }, hear, abort.signal).catch((error: unknown) => {
      if (this.#abort === abort) this.say(error instanceof ChannelError ? error.message : unread);
    });
  }

  protected say(words: string): void {
    this.#words = words;
    this.#changed();
  }

  /** A line of the answer that counts. */
  protected abstract hear(line: Line): void;

  /** Takes back what is shown. */
  protected abstract forget(): void;
}

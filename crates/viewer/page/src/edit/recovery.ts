/** The way on after a stop of the cell's plan, asked on request and shown in place of the plan. */
import type { View } from "../view.ts";
import { ChannelError, type Channel } from "./channel.ts";
import type { RecoveryLine, RecoveryQuestion } from "./protocol.ts";

/** Numbers of a text: six joint positions [deg]; null for an empty text. */
export function readJoints(text: string): number[] | null | "not six" {
  const words = text.split(/[\s,;°]+/).filter((word) => word !== "");
  if (words.length === 0) return null;
  const numbers = words.map(Number);
  return numbers.length === 6 && numbers.every(Number.isFinite) ? numbers : "not six";
}

export class RecoveryAsker {
  readonly #channel: Channel;
  readonly #session: string;
  readonly #changed: () => void;
  #abort: AbortController | null = null;
  #words: string | null = null;
  #view: View | null = null;
  /** The scenario that it is of. */
  #text = "";

  constructor(channel: Channel, session: string, changed: () => void) {
    this.#channel = channel;
    this.#session = `${session}r`;
    this.#changed = changed;
  }

  /** What is to be said about the recovery that is shown; null for none. */
  get words(): string | null {
    return this.#words;
  }

  /** The motion home, where there is one. */
  get view(): View | null {
    return this.#view;
  }

  /** Asks for the way on from where the arm stands, or from where the plan has it at that time. */
  ask(text: string, stopped_s: number | null, at_deg: number[] | null): void {
    this.#abort?.abort();
    const abort = new AbortController();
    this.#abort = abort;
    this.#text = text;
    this.#say("Planning and proving the way home …");
    const question: RecoveryQuestion = { session: this.#session, text, stopped_s, at_deg };
    this.#channel.ask("/recover", question, (line) => this.#hear(abort, line as RecoveryLine), abort.signal).catch((error: unknown) => {
      if (this.#abort === abort) this.#say(error instanceof ChannelError ? error.message : "The recovery cannot be read.");
    });
  }

  /** Says why nothing is asked. */
  refuse(words: string): void {
    this.clear();
    this.#abort = new AbortController();
    this.#say(words);
  }

  /** Shows none. */
  clear(): void {
    if (this.#abort === null) return;
    this.#abort.abort();
    this.#abort = null;
    this.#words = null;
    this.#view = null;
    this.#changed();
  }

  /** Gives it up where the cell is another by now. */
  follow(text: string, changing: boolean): void {
    if (this.#abort !== null && (changing || (this.#text !== "" && text !== this.#text))) this.clear();
  }

  #hear(abort: AbortController, line: RecoveryLine | null): void {
    if (this.#abort !== abort) return;
    switch (line?.kind) {
      case "recovery": {
        const rest = line.rest === null ? "All plates were washed." : `Then the rest: ${line.rest}.`;
        this.#view = line.view;
        return this.#say(`Stopped ${line.stop}. Shown: the motion home. ${rest}`);
      }
      case "refused":
      case "failed":
        return this.#say(line.words);
      default:
    }
  }

  #say(words: string): void {
    this.#words = words;
    this.#changed();
  }
}

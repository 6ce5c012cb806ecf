/** Where a plate could be washed, asked on request and shown as it comes. */
import type { Editing } from "../scene/editing.ts";
import { ChannelError, type Channel } from "./channel.ts";
import type { MapLine, MapQuestion } from "./protocol.ts";

export class MapAsker {
  readonly #channel: Channel;
  readonly #session: string;
  readonly #scene: () => Editing | null;
  readonly #changed: () => void;
  #abort: AbortController | null = null;
  #words: string | null = null;
  /** The scenario that it is of. */
  #text = "";

  constructor(channel: Channel, session: string, scene: () => Editing | null, changed: () => void) {
    this.#channel = channel;
    this.#session = `${session}m`;
    this.#scene = scene;
    this.#changed = changed;
  }

  /** What is to be said about the map that is shown; null for none. */
  get words(): string | null {
    return this.#words;
  }

  ask(text: string, plate: number, name: string): void {
    this.clear();
    const abort = new AbortController();
    this.#abort = abort;
    this.#text = text;
    this.#say(`Looking where ${name} could be washed …`);
    const question: MapQuestion = { session: this.#session, text, plate };
    this.#channel.ask("/map", question, (line) => this.#hear(abort, line as MapLine), abort.signal).catch((error: unknown) => {
      if (this.#abort === abort) this.#say(error instanceof ChannelError ? error.message : "The map cannot be read.");
    });
  }

  /** Shows none. */
  clear(): void {
    if (this.#abort === null) return;
    this.#abort.abort();
    this.#abort = null;
    this.#words = null;
    this.#scene()?.map(null);
    this.#changed();
  }

  /** Gives it up where the cell is another by now. */
  follow(text: string, changing: boolean): void {
    if (this.#abort !== null && (changing || text !== this.#text)) this.clear();
  }

  #hear(abort: AbortController, line: MapLine | null): void {
    if (this.#abort !== abort) return;
    switch (line?.kind) {
      case "map":
        return this.#scene()?.map(line);
      case "map_done":
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

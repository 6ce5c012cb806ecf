/** Newline-delimited JSON that arrives in pieces. */

/** Characters of a line at most: what is longer is no answer. */
const LONGEST = 64 * 1024 * 1024;

/** Puts lines together from bytes, wherever these are cut: within a line, or within a character. */
export class Lines {
  readonly #onLine: (line: unknown) => void;
  readonly #decoder = new TextDecoder();
  #rest: string[] = [];
  #length = 0;

  constructor(onLine: (line: unknown) => void) {
    this.#onLine = onLine;
  }

  push(bytes: Uint8Array): void {
    this.#take(this.#decoder.decode(bytes, { stream: true }));
  }

  /** No more comes. A last line without its end counts where it is whole. */
  end(): void {
    this.#take(`${this.#decoder.decode()}\n`);
  }

  #take(text: string): void {
    let from = 0;
    for (let at = text.indexOf("\n"); at >= 0; at = text.indexOf("\n", from)) {
      const line = this.#rest.join("") + text.slice(from, at);
      this.#rest = [];
      this.#length = 0;
      from = at + 1;
      this.#say(line);
    }
    if (from === text.length) return;
    this.#rest.push(text.slice(from));
    this.#length += text.length - from;
    if (this.#length > LONGEST) throw new RangeError("an answer has a line that is too long");
  }

  /** Blank lines only say that work goes on. */
  #say(line: string): void {
    if (line.trim() === "") return;
    let value: unknown;
    try {
      value = JSON.parse(line);
    } catch {
      throw new SyntaxError("an answer has a line that is no JSON");
    }
    this.#onLine(value);
  }
}

/** Questions to the server that the page came from. */
import { ChannelError, type Channel } from "./channel.ts";
import { Lines } from "./lines.ts";
import type { HelloLine } from "./protocol.ts";

export class HttpChannel implements Channel {
  readonly #token: () => string;
  readonly #fetch: typeof fetch;
  readonly #onHello: (hello: HelloLine) => void;

  /** `onHello`: the server that answers is not the one that the page came from. */
  constructor(token: () => string, onHello: (hello: HelloLine) => void, how: typeof fetch = (...given) => fetch(...given)) {
    this.#token = token;
    this.#onHello = onHello;
    this.#fetch = how;
  }

  async ask(path: string, question: object, onLine: (line: unknown) => void, signal: AbortSignal): Promise<void> {
    try {
      let answer = await this.#post(path, question, signal);
      if (answer.status === 403) {
        await answer.body?.cancel();
        await this.#hello(signal);
        answer = await this.#post(path, question, signal);
      }
      await read(answer, onLine, signal);
    } catch (error) {
      if (signal.aborted) return;
      if (error instanceof ChannelError) throw error;
      throw new ChannelError("lost", "The connection to platewash is lost.");
    }
  }

  #post(path: string, question: object, signal: AbortSignal): Promise<Response> {
    const headers = { "Content-Type": "application/json", "X-Platewash-Token": this.#token() };
    const body = JSON.stringify(question);
    return this.#fetch(path, { method: "POST", headers, body, signal, cache: "no-store", credentials: "same-origin", redirect: "error" });
  }

  /** Greets a server that was started after the page came, once another page of this address has brought its token. */
  async #hello(signal: AbortSignal): Promise<void> {
    const answer = await this.#post("/hello", {}, signal);
    if (answer.status === 403) {
      await answer.body?.cancel();
      throw new ChannelError("lost", "This page does not have the token of the running platewash: open the address that it printed.");
    }
    let hello: unknown = null;
    await read(answer, (line) => {
      hello ??= line;
    }, signal);
    if (!isHello(hello)) throw new ChannelError("refused", "What answers at this address is no live cell of this version of platewash.");
    this.#onHello(hello);
  }
}

function isHello(line: unknown): line is HelloLine {
  const hello = line as Partial<HelloLine> | null;
  return typeof hello === "object" && hello?.kind === "hello" && hello.format === "platewash-edit/1";
}

async function read(answer: Response, onLine: (line: unknown) => void, signal: AbortSignal): Promise<void> {
  if (answer.status === 503) throw new ChannelError("busy", "platewash is busy with other questions.");
  if (!answer.ok) {
    const words = (await answer.text().catch(() => "")).trim().slice(0, 300);
    throw new ChannelError("refused", `platewash refused the question (${answer.status}). ${words}`.trim());
  }
  const lines = new Lines((line) => {
    if (!signal.aborted) onLine(line);
  });
  const reader = answer.body?.getReader();
  if (reader === undefined) return;
  for (let next = await reader.read(); !next.done; next = await reader.read()) lines.push(next.value);
  lines.end();
}

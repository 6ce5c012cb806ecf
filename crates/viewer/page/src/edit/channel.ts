/** The way to whoever plans, questions there and lines of answers back: to the server that the page came from, or to the window around it. */
import type { HelloLine } from "./protocol.ts";

/** Why a question was not answered to its end: nobody is there, too much is asked, or it is not wanted. */
export type Loss = "lost" | "busy" | "refused";

export class ChannelError extends Error {
  override name = "ChannelError";
  readonly loss: Loss;

  constructor(loss: Loss, words: string) {
    super(words);
    this.loss = loss;
  }
}

export interface Channel {
  /**
   * Asks. Each line of the answer is handed on as it comes; ends with its last one. `ChannelError` where there is no answer. A question
   * that is aborted ends without a word.
   */
  ask(path: string, question: object, onLine: (line: unknown) => void, signal: AbortSignal): Promise<void>;
}

/** The first line of an answer that has only one; null where it was aborted or empty. */
export async function askOnce(channel: Channel, path: string, question: object, signal: AbortSignal): Promise<unknown> {
  let first: unknown = null;
  await channel.ask(path, question, (line) => {
    first ??= line;
  }, signal);
  return first;
}

/** Time to wait before question number `tries` again [ms]: from 0.3 s to 2 s. */
export function backOff(tries: number): number {
  return Math.min(2000, 300 * 2 ** Math.max(0, Math.min(10, tries)));
}

/** Newline-delimited JSON from bytes, wherever these are cut: within a line, or within a character. */
export class Lines {
  readonly #onLine: (line: unknown) => void;
  readonly #decoder = new TextDecoder();
  #rest = "";

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
    this.#rest += text;
    if (!text.includes("\n")) return;
    const lines = this.#rest.split("\n");
    this.#rest = lines.pop() ?? "";
    // Blank lines only say that work goes on.
    for (const line of lines) if (line.trim() !== "") this.#onLine(JSON.parse(line));
  }
}

/** Questions to the server that the page came from. */
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

/** The token of the server, without which it answers no question: the address that `platewash edit` printed has it. */
const KEY = "platewash-token";
const TOKEN = /^[0-9a-f]{32}$/;

/** Where there is no storage, for this page alone. */
let own = "";

/** Takes the token out of the page's address, so that it is in no bookmark, and keeps it for pages of this address. */
export function takeToken(): void {
  const entries = new URLSearchParams(location.hash.slice(1));
  const given = entries.get("token");
  if (given === null || !TOKEN.test(given)) return;
  own = given;
  try {
    localStorage.setItem(KEY, given);
  } catch {
    // A page that may store nothing asks as long as it is open.
  }
  entries.delete("token");
  const rest = entries.toString();
  history.replaceState(history.state, "", rest === "" ? location.pathname + location.search : `#${rest}`);
}

/** The token that was taken last by a page of this address; empty where none was. */
export function keptToken(): string {
  try {
    return localStorage.getItem(KEY) ?? own;
  } catch {
    return own;
  }
}

/** What this needs of a window. */
export interface FrameWindow {
  parent: { postMessage(message: unknown, origin: string): void };
  addEventListener(type: "message", listener: (event: { source: unknown; data: unknown }) => void): void;
}

interface Open {
  onLine: (line: unknown) => void;
  end: () => void;
  fail: (error: ChannelError) => void;
}

/**
 * `{platewash: id, path, question}` goes out, `{platewash: id, line}` and `{platewash: id, end: true}` come back; an aborted question is
 * told by `{platewash: id, abort: true}`. `{platewash: "take", text}` hands the page another scenario.
 */
export class FrameChannel implements Channel {
  readonly #window: FrameWindow;
  readonly #open = new Map<number, Open>();
  #last = 0;

  constructor(window: FrameWindow, onTake: (text: string) => void) {
    this.#window = window;
    window.addEventListener("message", ({ source, data }) => {
      if (source === window.parent && typeof data === "object" && data !== null) this.#hear(data as Record<string, unknown>, onTake);
    });
  }

  ask(path: string, question: object, onLine: (line: unknown) => void, signal: AbortSignal): Promise<void> {
    if (signal.aborted) return Promise.resolve();
    const id = ++this.#last;
    return new Promise((resolve, reject) => {
      const close = (): void => {
        this.#open.delete(id);
        signal.removeEventListener("abort", abort);
      };
      const abort = (): void => {
        close();
        this.#post({ platewash: id, abort: true });
        resolve();
      };
      this.#open.set(id, { onLine, end: () => (close(), resolve()), fail: (error) => (close(), reject(error)) });
      signal.addEventListener("abort", abort);
      this.#post({ platewash: id, path, question });
    });
  }

  /** The window around the page has an origin that the page cannot know. */
  #post(message: object): void {
    this.#window.parent.postMessage(message, "*");
  }

  #hear(message: Record<string, unknown>, onTake: (text: string) => void): void {
    const id = message["platewash"];
    if (id === "take" && typeof message["text"] === "string") onTake(message["text"]);
    if (typeof id !== "number") return;
    const open = this.#open.get(id);
    if (open === undefined) return;
    if (typeof message["error"] === "string") open.fail(new ChannelError("lost", message["error"].slice(0, 300)));
    else if (message["end"] === true) open.end();
    else if ("line" in message) open.onLine(parsed(message["line"]));
  }
}

/** Lines come as objects, or as the text that they are on other ways. */
function parsed(line: unknown): unknown {
  if (typeof line !== "string") return line;
  try {
    return JSON.parse(line) as unknown;
  } catch {
    return null;
  }
}

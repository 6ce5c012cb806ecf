/** The engine in WebAssembly: loading it, and asking its workers. */
import { ChannelError, type Channel } from "../edit/channel.ts";
import type { CellQuestion } from "../edit/protocol.ts";

/** Reason that there is no engine, in words for the user. */
export class EngineError extends Error {
  override name = "EngineError";
}

const NOT_ALLOWED = "This browser cannot compile the engine: it is too old, or the server’s Content-Security-Policy does not allow WebAssembly.";
const TOO_OLD =
  "This browser cannot run platewash, which needs WebAssembly and web workers: take Chrome or Edge 111, Firefox 113, Safari 16.4, or a later one.";
const NO_SERVER = "This page needs a web server: run “python3 -m http.server --bind 127.0.0.1” in its folder, and open the address that it prints.";

/** Loads and compiles the module; `onShare` is told the share of it that is there. */
export async function loadEngine(bytes: number, onShare: (share: number) => void): Promise<WebAssembly.Module> {
  if (location.protocol === "file:") throw new EngineError(NO_SERVER);
  if (typeof WebAssembly !== "object" || typeof DecompressionStream !== "function" || typeof Worker !== "function") throw new EngineError(TOO_OLD);
  let answer: Response;
  try {
    answer = await fetch("engine.bin");
  } catch {
    throw new EngineError("The engine cannot be loaded: the connection is lost. Load the page again.");
  }
  if (!answer.ok || answer.body === null) throw new EngineError(`The engine cannot be loaded: the server answers ${answer.status} for engine.bin.`);
  let loaded = 0;
  const counted = new TransformStream<Uint8Array<ArrayBuffer>, Uint8Array<ArrayBuffer>>({
    transform: (chunk, to) => {
      loaded += chunk.length;
      onShare(Math.min(1, loaded / bytes));
      to.enqueue(chunk);
    },
  });
  const plain = answer.body.pipeThrough(counted).pipeThrough(new DecompressionStream("gzip"));
  try {
    return await WebAssembly.compileStreaming(new Response(plain, { headers: { "Content-Type": "application/wasm" } }));
  } catch (error) {
    if (error instanceof WebAssembly.CompileError) throw new EngineError(NOT_ALLOWED);
    throw new EngineError("The engine cannot be read: the file is damaged, or the connection was lost. Load the page again.");
  }
}

/** Loads the program of the workers once, so that no later one depends on the network. */
export async function loadWorker(): Promise<string> {
  const answer = await fetch("worker.js").catch(() => null);
  if (answer?.ok !== true) throw new EngineError(`The engine cannot be loaded: the server answers ${answer?.status ?? "nothing"} for worker.js.`);
  return URL.createObjectURL(new Blob([await answer.text()], { type: "text/javascript" }));
}

/** What a worker is told. */
export type ToWorker = { module: WebAssembly.Module } | { path: string; question: string };

/** What a worker tells: a line of an answer, its end, or why the worker is of no more use. */
export type FromWorker = { line: string } | { end: true } | { error: string };

const FAULT = "a fault of the program: the console of the browser says more";

/** Questions that wait for each other share a lane: all that come before the first proof are asked on its worker. */
function laneOf(path: string, question: object): string {
  if (path === "/cell") return (question as CellQuestion).want;
  if (path === "/recover") return "/map";
  return path === "/map" || path === "/file" ? path : "proof";
}

/** One question at a time, on a worker of its own. */
class Lane {
  readonly #start: () => Worker;
  #worker: Worker | null = null;
  #last: Promise<void> = Promise.resolve();

  constructor(start: () => Worker) {
    this.#start = start;
  }

  ask(path: string, question: object, onLine: (line: unknown) => void, signal: AbortSignal): Promise<void> {
    const answered = this.#last.then(() => (signal.aborted ? undefined : this.#answered(path, question, onLine, signal)));
    this.#last = answered.catch(() => undefined);
    return answered;
  }

  #answered(path: string, question: object, onLine: (line: unknown) => void, signal: AbortSignal): Promise<void> {
    const worker = (this.#worker ??= this.#start());
    return new Promise((resolve, reject) => {
      const close = (): void => {
        worker.onmessage = worker.onerror = null;
        signal.removeEventListener("abort", giveUp);
      };
      // A worker that computes hears nothing: it is ended, and another one takes its place.
      const end = (): void => {
        close();
        worker.terminate();
        this.#worker = null;
      };
      const giveUp = (): void => (end(), resolve());
      const fail = (words: string): void => (end(), reject(new ChannelError("refused", words)));
      worker.onerror = () => fail(FAULT);
      worker.onmessage = ({ data }: MessageEvent<FromWorker>) => {
        if ("line" in data) onLine(JSON.parse(data.line));
        else if ("end" in data) (close(), resolve());
        else {
          console.error(data.error);
          fail(FAULT);
        }
      };
      signal.addEventListener("abort", giveUp);
      worker.postMessage({ path, question: JSON.stringify(question) } satisfies ToWorker);
    });
  }
}

/** Asks workers of this browser in place of a server. */
export class WorkerChannel implements Channel {
  readonly #module: WebAssembly.Module;
  /** Address of the workers' program. */
  readonly #program: string;
  readonly #lanes = new Map<string, Lane>();
  /** Ready for the lane that needs one next. */
  #spare: Worker;

  constructor(module: WebAssembly.Module, program: string) {
    this.#module = module;
    this.#program = program;
    this.#spare = this.#begin();
  }

  ask(path: string, question: object, onLine: (line: unknown) => void, signal: AbortSignal): Promise<void> {
    const name = laneOf(path, question);
    let lane = this.#lanes.get(name);
    if (lane === undefined) {
      lane = new Lane(() => this.#next());
      this.#lanes.set(name, lane);
    }
    return lane.ask(path, question, onLine, signal);
  }

  #next(): Worker {
    const next = this.#spare;
    this.#spare = this.#begin();
    return next;
  }

  #begin(): Worker {
    const worker = new Worker(this.#program);
    worker.postMessage({ module: this.#module } satisfies ToWorker);
    return worker;
  }
}

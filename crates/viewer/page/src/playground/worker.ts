/** A worker that answers questions with the module of `crates/playground`. */
import type { FromWorker, ToWorker } from "./engine.ts";

/** What the module exports: `crates/playground/src/module.rs`. */
interface Exports {
  memory: WebAssembly.Memory;
  /** Makes room for a question; where it is to be written. */
  reserve(bytes: number): number;
  answer(): void;
}

const tell = (message: FromWorker): void => postMessage(message);

let exports: Promise<Exports> | null = null;
/** Message of a panic. */
let fault: string | null = null;

async function instantiated(module: WebAssembly.Module): Promise<Exports> {
  const text = (at: number, bytes: number): string => new TextDecoder().decode(new Uint8Array(own.memory.buffer, at, bytes));
  const host = {
    now: () => performance.now(),
    tell: (at: number, bytes: number) => tell({ line: text(at, bytes) }),
    fail: (at: number, bytes: number) => {
      fault = text(at, bytes);
    },
  };
  const own = (await WebAssembly.instantiate(module, { host })).exports as unknown as Exports;
  return own;
}

function answer(own: Exports, path: string, question: string): void {
  const bytes = new TextEncoder().encode(`${path}\n${question}`);
  const at = own.reserve(bytes.length);
  new Uint8Array(own.memory.buffer, at, bytes.length).set(bytes);
  own.answer();
}

onmessage = async ({ data }: MessageEvent<ToWorker>) => {
  if ("module" in data) {
    exports = instantiated(data.module);
    return;
  }
  try {
    if (exports === null) throw new Error("the worker has no module");
    answer(await exports, data.path, data.question);
    tell({ end: true });
  } catch (error) {
    tell({ error: fault ?? String(error) });
  }
};

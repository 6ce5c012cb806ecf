/** An instance of the playground's module, as a worker of the browser drives it. */
import { readFile } from "node:fs/promises";

/** Starts the module in a file; its `ask` answers a question with the lines of the answer. */
export async function started(file) {
  const lines = [];
  const bytes = (at, count) => new Uint8Array(exports.memory.buffer, at, count);
  const text = (at, count) => new TextDecoder("utf-8", { fatal: true }).decode(bytes(at, count));
  const host = {
    now: () => performance.now(),
    tell: (at, count) => lines.push(JSON.parse(text(at, count))),
    fail: (at, count) => {
      throw new Error(`the module panics: ${text(at, count)}`);
    },
  };
  const { instance } = await WebAssembly.instantiate(await readFile(file), { host });
  const { exports } = instance;

  /** `question`: a value, or a text as it is. */
  const ask = (path, question) => {
    const words = typeof question === "string" ? question : JSON.stringify(question);
    const asked = new TextEncoder().encode(`${path}\n${words}`);
    bytes(exports.reserve(asked.length), asked.length).set(asked);
    exports.answer();
    return lines.splice(0);
  };
  return { ask };
}

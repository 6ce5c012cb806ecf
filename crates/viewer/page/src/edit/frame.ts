/** Questions to the window around the page, for notebooks. */
import { ChannelError, type Channel } from "./channel.ts";

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

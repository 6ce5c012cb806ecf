/** What a reload must not lose, kept by the browser for this tab. */
import type { Step } from "./history.ts";

export interface Kept {
  steps: readonly Step[];
  at: number;
  /** SHA-256 of what the page takes to stand on disk. */
  disk: string | null;
  /** The text that stands there; null where it is not known. */
  saved: string | null;
}

/** What this needs of `sessionStorage`. */
export type Store = Pick<Storage, "getItem" | "setItem" | "removeItem">;

/** Characters that are kept at most: browsers give some five millions a page. */
const MOST = 2_000_000;
/** Fewer characters, where even those did not fit. */
const FEWER = [MOST, 400_000, 60_000];

/** The tab's store; null where the page may not keep anything. */
export function tabStore(): Store | null {
  try {
    return window.sessionStorage;
  } catch {
    return null;
  }
}

export class Keeper {
  readonly #store: Store | null;
  readonly #key: string;
  #works: boolean;

  /** `of` tells scenarios apart: the file, or the text that the page came with where there is none. */
  constructor(store: Store | null, of: string) {
    this.#store = store;
    this.#works = store !== null;
    this.#key = `platewash-edit ${of.length} ${hash(of)}`;
  }

  /** Whether what is done is kept beyond this load of the page. */
  get works(): boolean {
    return this.#works;
  }

  load(): Kept | null {
    try {
      return kept(JSON.parse(this.#store?.getItem(this.#key) ?? "null"));
    } catch {
      return null;
    }
  }

  /** As many of the steps around the one that stands as fit. */
  save(what: Kept): void {
    this.#works = this.#store !== null && FEWER.some((most) => this.#put(within(what, most)));
  }

  #put(what: Kept): boolean {
    try {
      this.#store?.setItem(this.#key, JSON.stringify(what));
      return true;
    } catch {
      return false;
    }
  }
}

/** The steps nearest to the one that stands, which is always among them. */
function within(what: Kept, most: number): Kept {
  const size = (step: Step | undefined): number => (step === undefined ? 0 : JSON.stringify(step).length);
  let [from, to] = [what.at, what.at + 1];
  let left = most - size(what.steps[what.at]);
  while (from > 0 && left >= size(what.steps[from - 1])) left -= size(what.steps[--from]);
  while (to < what.steps.length && left >= size(what.steps[to])) left -= size(what.steps[to++]);
  return { ...what, steps: what.steps.slice(from, to), at: what.at - from };
}

function isStep(value: unknown): value is Step {
  const step = value as Partial<Step> | null;
  const version = step?.version;
  return typeof step?.label === "string" && typeof version?.text === "string" && Array.isArray(version.edits);
}

function kept(value: unknown): Kept | null {
  const found = value as Partial<Kept> | null;
  if (found === null || !Array.isArray(found.steps) || found.steps.length === 0 || !found.steps.every(isStep)) return null;
  const at = Number.isInteger(found.at) ? Math.max(0, Math.min(found.steps.length - 1, found.at!)) : found.steps.length - 1;
  const text = (one: unknown): string | null => (typeof one === "string" ? one : null);
  return { steps: found.steps, at, disk: text(found.disk), saved: text(found.saved) };
}

/** Tells texts apart, against nobody's intent (FNV-1a). */
function hash(text: string): string {
  let value = 0x811c9dc5;
  for (let k = 0; k < text.length; k++) value = Math.imul(value ^ text.charCodeAt(k), 0x01000193);
  return (value >>> 0).toString(16);
}

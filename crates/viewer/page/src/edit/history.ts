/** Every scenario that there was, to go back to and forth again, and how a reload does not lose them. */
import type { CellQuestion, Value } from "./protocol.ts";

export type Edit = CellQuestion["edits"][number];

/** A scenario: a text, and the changes to it that whoever plans has not written into it yet. */
export interface Version {
  readonly text: string;
  readonly edits: readonly Edit[];
}

/** Whether two values are the same, to the bit. */
export function sameValue(a: Value | null, b: Value | null): boolean {
  if (!Array.isArray(a) || !Array.isArray(b)) return Object.is(a, b) || (typeof a === "object" && JSON.stringify(a) === JSON.stringify(b));
  return a.length === b.length && a.every((value, k) => sameValue(value as Value, b[k] as Value));
}

export function sameVersion(a: Version, b: Version): boolean {
  if (a === b) return true;
  if (a.text !== b.text || a.edits.length !== b.edits.length) return false;
  return a.edits.every((edit, k) => edit.key === b.edits[k]!.key && sameValue(edit.value, b.edits[k]!.value));
}

/** Whether a change takes out a whole section, and when: the one behind first, so that the others keep their numbers. */
function takenAt({ key, value }: Edit): number {
  const section = value === null ? /\[(\d+)\]$/.exec(key)?.[1] : undefined;
  return section === undefined ? 0 : Number.MAX_SAFE_INTEGER - Number(section);
}

/** The version with more changes: the last change of a key counts. Sections are taken out last: until then keys count them as they are drawn. */
export function changed(version: Version, edits: readonly Edit[]): Version {
  const keys = new Set(edits.map(({ key }) => key));
  const kept = version.edits.filter(({ key }) => !keys.has(key));
  const last = edits.filter(({ key }, k) => edits.findLastIndex((one) => one.key === key) === k);
  return { text: version.text, edits: [...kept, ...last].sort((a, b) => takenAt(a) - takenAt(b)) };
}

export interface Step {
  readonly version: Version;
  /** What led to it. */
  readonly label: string;
}

export class History {
  #steps: Step[];
  #at: number;

  /** Goes on with steps that were stored, or begins with one. */
  constructor(steps: readonly Step[], at = steps.length - 1) {
    if (steps.length === 0) throw new RangeError("a history without a scenario");
    this.#steps = [...steps];
    this.#at = Math.max(0, Math.min(steps.length - 1, at));
  }

  get version(): Version {
    return this.#steps[this.#at]!.version;
  }

  get steps(): readonly Step[] {
    return this.#steps;
  }

  get at(): number {
    return this.#at;
  }

  /** What undoing would take back; null where there is nothing. */
  get undoes(): string | null {
    return this.#at > 0 ? this.#steps[this.#at]!.label : null;
  }

  /** What redoing would do again. */
  get redoes(): string | null {
    return this.#steps[this.#at + 1]?.label ?? null;
  }

  /** A new step, unless nothing is different; whether it is one. What was undone is gone. */
  commit(version: Version, label: string): boolean {
    if (sameVersion(version, this.version)) return false;
    this.#steps.length = this.#at + 1;
    this.#steps.push({ version, label });
    this.#at++;
    return true;
  }

  /** Another version in place of the newest step's: for changes that follow each other closely. */
  amend(version: Version): void {
    this.#steps.length = this.#at + 1;
    this.settle(version);
  }

  /** The version that stands now as it is written out. Where that is no other than the step before, there was no step. */
  settle(version: Version): void {
    const { label } = this.#steps[this.#at]!;
    this.#steps[this.#at] = { version, label };
    for (const beside of [this.#at - 1, this.#at]) {
      const [one, next] = [this.#steps[beside], this.#steps[beside + 1]];
      if (one === undefined || next === undefined || !sameVersion(one.version, next.version)) continue;
      this.#steps.splice(beside + 1, 1);
      if (beside < this.#at) this.#at--;
    }
  }

  undo(): boolean {
    if (this.#at === 0) return false;
    this.#at--;
    return true;
  }

  redo(): boolean {
    if (this.#at + 1 >= this.#steps.length) return false;
    this.#at++;
    return true;
  }
}

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

/** Keeps the steps for this tab. */
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

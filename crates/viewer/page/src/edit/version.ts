/** A scenario: a text, and the changes to it that whoever plans has not written into it yet. */
import type { CellQuestion, Value } from "./protocol.ts";

export type Edit = CellQuestion["edits"][number];

export interface Version {
  readonly text: string;
  readonly edits: readonly Edit[];
}

/** Whether two values are the same, to the bit. */
export function sameValue(a: Value | null, b: Value | null): boolean {
  if (!Array.isArray(a) || !Array.isArray(b)) return Object.is(a, b);
  return a.length === b.length && a.every((value, k) => sameValue(value as Value, b[k] as Value));
}

export function sameVersion(a: Version, b: Version): boolean {
  if (a === b) return true;
  if (a.text !== b.text || a.edits.length !== b.edits.length) return false;
  return a.edits.every((edit, k) => edit.key === b.edits[k]!.key && sameValue(edit.value, b.edits[k]!.value));
}

/** The version with more changes: the last change of a key counts. */
export function changed(version: Version, edits: readonly Edit[]): Version {
  const keys = new Set(edits.map(({ key }) => key));
  const kept = version.edits.filter(({ key }) => !keys.has(key));
  const last = edits.filter(({ key }, k) => edits.findLastIndex((one) => one.key === key) === k);
  return { text: version.text, edits: [...kept, ...last] };
}

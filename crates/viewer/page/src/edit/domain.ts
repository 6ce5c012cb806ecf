/** What may be typed for a key, and what that is as a value. */
import type { FormDomain, FormKey, Value } from "./protocol.ts";

/** A value, or that there is none for what was typed. */
export type Read = { value: Value } | { wrong: true };

const WRONG: Read = { wrong: true };
const NUMBER = /^[+-]?(\d[\d_]*)?(\.\d*)?(e[+-]?\d{1,3})?$/i;

/** A finite number as people type it, with a real minus sign or a comma too; null for what is none. */
export function readNumber(text: string): number | null {
  const plain = text.trim().replace("\u2212", "-").replace(/^([+-]?\d*),(\d+)$/, "$1.$2");
  if (!NUMBER.test(plain) || !/\d/.test(plain)) return null;
  const value = Number(plain.replaceAll("_", ""));
  return Number.isFinite(value) ? value : null;
}

/** The text of a number: the shortest that reads back exactly. */
export function numberText(value: number): string {
  return String(value);
}

/** What a control shows for a value. */
export function valueText(value: Value): string {
  if (Array.isArray(value)) return value.map((one: Value) => (Array.isArray(one) ? `[${valueText(one)}]` : valueText(one))).join(", ");
  if (typeof value === "object") return Object.entries(value as Record<string, number>).map(([name, one]) => `${name} = ${numberText(one)}`).join(", ");
  return typeof value === "number" ? numberText(value) : String(value);
}

/** Whether a number is within a domain. */
function within(value: number, domain: Extract<FormDomain, { least: number }>): boolean {
  const above = domain.kind === "number_above" || domain.kind === "joints_above" || domain.kind === "pair_above" || domain.kind === "triple_above";
  return (above ? value > domain.least : value >= domain.least) && value <= domain.most;
}

/** Numbers between commas, spaces or brackets. */
function numbers(text: string): number[] | null {
  const parts = text.replace(/[[\]()]/g, " ").trim().split(/[\s,;]+/).filter((part) => part !== "");
  const values = parts.map(readNumber);
  return values.every((value) => value !== null) ? values : null;
}

function isControl(text: string): boolean {
  return /[\u0000-\u001f\u007f-\u009f]/.test(text);
}

/** Reads what was typed for a key. */
export function readValue({ domain }: Pick<FormKey, "domain">, text: string): Read {
  switch (domain.kind) {
    case "text":
    case "path":
      return isControl(text) || (domain.kind === "path" && text.trim() === "") ? WRONG : { value: text };
    case "paths":
      return { value: text.split(/\r?\n|,/).map((part) => part.trim()).filter((part) => part !== "") };
    case "bool":
      return text === "true" || text === "false" ? { value: text === "true" } : WRONG;
    case "word":
      return domain.words.includes(text) ? { value: text } : WRONG;
    case "integer":
    case "number":
    case "number_above":
      return scalar(readNumber(text), domain);
    case "range":
    case "joints":
    case "joints_above":
    case "pair":
    case "pair_above":
    case "triple":
    case "triple_above":
    case "points":
      return list(numbers(text), domain);
    case "positions":
      return positions(text, domain);
  }
}

/** Names with a number each, such as "rail = 0.3, finger = 0". */
function positions(text: string, domain: Extract<FormDomain, { least: number }>): Read {
  const found: Record<string, number> = {};
  for (const part of text.split(/[,\n]/).filter((part) => part.trim() !== "")) {
    const at = part.lastIndexOf("=");
    const name = part.slice(0, Math.max(at, 0)).trim();
    const value = readNumber(part.slice(at + 1));
    if (name === "" || isControl(name) || value === null || !within(value, domain) || Object.hasOwn(found, name)) return WRONG;
    found[name] = value;
  }
  return { value: found };
}

function scalar(value: number | null, domain: Extract<FormDomain, { least: number }>): Read {
  const fits = value !== null && within(value, domain) && (domain.kind !== "integer" || Number.isSafeInteger(value));
  return fits ? { value } : WRONG;
}

function list(values: number[] | null, domain: Extract<FormDomain, { least: number }>): Read {
  if (values === null || !values.every((value) => within(value, domain))) return WRONG;
  if (domain.kind === "range") return values.length === 2 && values[0]! < values[1]! ? { value: values } : WRONG;
  if (domain.kind === "pair" || domain.kind === "pair_above") return values.length === 2 ? { value: values } : WRONG;
  if (domain.kind === "triple" || domain.kind === "triple_above") return values.length === 3 ? { value: values } : WRONG;
  if (domain.kind !== "points") return values.length === 6 ? { value: values } : WRONG;
  if (values.length < 2 || values.length > 2000 || values.length % 2 !== 0) return WRONG;
  return { value: Array.from({ length: values.length / 2 }, (_, k) => [values[2 * k]!, values[2 * k + 1]!]) };
}

/** The number a step up or down from what is typed: by its last digit, or ten of those. */
export function stepped(text: string, direction: 1 | -1, coarse: boolean, domain: Extract<FormDomain, { least: number }>): string | null {
  const value = readNumber(text);
  if (value === null) return null;
  const decimals = domain.kind === "integer" ? 0 : Math.min(12, /\.(\d+)/.exec(text)?.[1]?.length ?? (Number.isInteger(value) && Math.abs(value) >= 10 ? 0 : 1));
  const to = value + direction * (coarse ? 10 : 1) * 10 ** -decimals;
  const rounded = Number(to.toFixed(decimals));
  return within(rounded, domain) ? rounded.toFixed(decimals) : null;
}

/** Of two words, how many letters have to be put in, left out, changed or swapped with their neighbour. */
export function distance(a: string, b: string): number {
  const width = b.length + 1;
  let [before, last] = [new Array<number>(width).fill(0), Array.from({ length: width }, (_, k) => k)];
  for (let i = 1; i <= a.length; i++) {
    const row = new Array<number>(width).fill(i);
    for (let j = 1; j < width; j++) {
      const same = a[i - 1] === b[j - 1];
      row[j] = Math.min(last[j]! + 1, row[j - 1]! + 1, last[j - 1]! + (same ? 0 : 1));
      if (i > 1 && j > 1 && a[i - 1] === b[j - 2] && a[i - 2] === b[j - 1]) row[j] = Math.min(row[j]!, before[j - 2]! + 1);
    }
    [before, last] = [last, row];
  }
  return last[width - 1]!;
}

/** How far what was typed is from a key: from the whole of it, its name, or a part of that. */
function farFrom(typed: string, key: string): number {
  const name = key.slice(key.lastIndexOf(".") + 1);
  return Math.min(...[key, name, ...key.split(/[._]/)].map((part) => distance(typed, part) + (part === key || part === name ? 0 : 0.5)));
}

/** The keys that were meant, perhaps: the nearest first, none where all are far. */
export function suggestions(typed: string, keys: readonly string[], most = 3): string[] {
  const word = typed.trim().toLowerCase().slice(0, 60);
  if (word === "") return [];
  const near = keys.map((key) => ({ key, far: farFrom(word, key) })).filter(({ far }) => far <= Math.max(1, 0.4 * word.length));
  return near.sort((a, b) => a.far - b.far || (a.key < b.key ? -1 : 1)).slice(0, most).map(({ key }) => key);
}

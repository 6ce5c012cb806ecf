/** The form of all keys, section by section as in `docs/scenario.md`, made from the program's own table. */
import { button, el } from "../shell/dom.ts";
import { KeyRow } from "./key-row.ts";
import type { Key, Value } from "./protocol.ts";
import { suggestions } from "./suggest.ts";

/** Sections that are open from the start. */
const OPEN: ReadonlySet<string> = new Set(["", "job", "tool", "layout", "wash"]);

interface Section {
  element: HTMLDetailsElement;
  rows: KeyRow[];
  open: boolean;
}

export interface FormShown {
  stated: Readonly<Record<string, Value>>;
  values: Readonly<Record<string, Value>>;
  /** What was refused, where it is about a key. */
  refused: { key: string; words: string } | null;
}

export class Form {
  readonly element: HTMLElement;
  readonly #rows: KeyRow[];
  readonly #sections: Section[];
  readonly #search = el("input", { class: "key-search", set: { type: "search", placeholder: "Search keys", "aria-label": "Search keys", autocomplete: "off", spellcheck: "false" } });
  readonly #none = el("p", { class: "summary", set: { role: "status" } });
  #shown: FormShown | null = null;

  constructor(keys: readonly Key[], onValue: (key: string, value: Value | null) => void) {
    this.#rows = keys.map((key) => new KeyRow(key, onValue));
    const sections = new Map<string, KeyRow[]>();
    for (const row of this.#rows) {
      const name = row.key.path.slice(0, Math.max(0, row.key.path.lastIndexOf(".")));
      sections.set(name, [...(sections.get(name) ?? []), row]);
    }
    this.#sections = [...sections].map(([name, rows]) => section(name, rows));
    this.#search.addEventListener("input", () => this.#filter());
    this.#none.hidden = true;
    this.element = el("div", { class: "key-form" }, this.#search, this.#none, ...this.#sections.map(({ element }) => element));
  }

  show(shown: FormShown): void {
    const before = this.#shown;
    if (before !== null && before.stated === shown.stated && before.values === shown.values && before.refused?.words === shown.refused?.words && before.refused?.key === shown.refused?.key) return;
    this.#shown = shown;
    const of = (values: Readonly<Record<string, Value>>, path: string): Value | undefined => (Object.hasOwn(values, path) ? values[path] : undefined);
    for (const row of this.#rows) {
      const { path } = row.key;
      row.show(of(shown.stated, path), of(shown.values, path), shown.refused?.key === path ? shown.refused.words : null);
    }
    const refused = this.#sections.find(({ rows }) => rows.some(({ key }) => key.path === shown.refused?.key));
    if (refused !== undefined) refused.element.open = true;
  }

  #filter(): void {
    const words = this.#search.value.trim().toLowerCase().split(/\s+/).filter((word) => word !== "");
    let found = 0;
    for (const { element, rows, open } of this.#sections) {
      const fits = rows.map((row) => row.matches(words));
      rows.forEach((row, k) => (row.element.hidden = !fits[k]));
      found += fits.filter(Boolean).length;
      element.hidden = !fits.includes(true);
      element.open = words.length > 0 || open;
    }
    this.#none.hidden = found > 0;
    if (found > 0) return;
    const near = suggestions(this.#search.value, this.#rows.map(({ key }) => key.path));
    const go = (path: string): HTMLElement => button({ class: "button text-button" }, () => this.#goTo(path), path);
    this.#none.replaceChildren("No key has that. ", ...(near.length === 0 ? [] : ["Did you mean ", ...near.flatMap((path) => [go(path), " "]), "?"]));
  }

  #goTo(path: string): void {
    this.#search.value = path;
    this.#filter();
    this.#rows.find(({ key }) => key.path === path)?.focus();
  }
}

function section(name: string, rows: KeyRow[]): Section {
  const open = OPEN.has(name);
  const title = el("summary", {}, name === "" ? "Top level" : name);
  const fields = el("fieldset", {}, el("legend", { class: "spoken" }, name === "" ? "Top level" : name), ...rows.map(({ element }) => element));
  const made: Section = { element: el("details", { class: "key-section" }, title, fields), rows, open };
  made.element.open = open;
  title.addEventListener("click", () => {
    made.open = !made.element.open;
  });
  return made;
}

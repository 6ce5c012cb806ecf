/** The scenario as a form of all keys, made from the program's own table, and as text. */
import { button, el, isolated } from "../shell/dom.ts";
import { readValue, stepped, suggestions, valueText } from "./domain.ts";
import { sameValue } from "./history.ts";
import type { FormKey, Value } from "./protocol.ts";

/** A control for the value of a key, by its domain. */
export interface Control {
  readonly element: HTMLInputElement | HTMLSelectElement | HTMLTextAreaElement;
  /** What is in it, as `readValue` reads it. */
  read(): string;
  /** Shows what the text states, or what counts without it. */
  show(stated: Value | undefined, counts: Value | undefined): void;
}

export interface ControlActions {
  /** What is typed has changed. */
  typed(): void;
  /** It is meant. */
  commit(): void;
  /** It is not. */
  revert(): void;
}

export function controlFor(key: FormKey, actions: ControlActions): Control {
  switch (key.domain.kind) {
    case "word":
      return select(key.domain.words, actions);
    case "bool":
      return checkbox(actions);
    case "points":
    case "paths":
      return area(key, actions);
    default:
      return field(key, actions);
  }
}

function select(words: readonly string[], actions: ControlActions): Control {
  const none = el("option", { set: { value: "" } }, "–");
  const element = el("select", {}, none, ...words.map((word) => el("option", { set: { value: word } }, word)));
  element.addEventListener("change", () => (element.value === "" ? actions.revert() : actions.commit()));
  return {
    element,
    read: () => element.value,
    show: (stated, counts) => {
      none.hidden = counts !== undefined;
      element.value = String(stated ?? counts ?? "");
    },
  };
}

function checkbox(actions: ControlActions): Control {
  const element = el("input", { set: { type: "checkbox" } });
  element.addEventListener("change", () => actions.commit());
  return {
    element,
    read: () => String(element.checked),
    show: (stated, counts) => {
      element.checked = (stated ?? counts) === true;
    },
  };
}

function area(key: FormKey, actions: ControlActions): Control {
  const element = el("textarea", { set: { rows: 3, spellcheck: "false", autocomplete: "off", wrap: "off" } });
  const text = (value: Value): string => (Array.isArray(value) ? value.map((one: Value) => valueText(one)).join("\n") : valueText(value));
  element.addEventListener("input", () => actions.typed());
  element.addEventListener("change", () => actions.commit());
  element.addEventListener("keydown", (event) => {
    if (event.key === "Enter" && (event.ctrlKey || event.metaKey)) actions.commit();
    if (event.key === "Escape") actions.revert();
  });
  element.title = key.domain.kind === "points" ? "A line a pair: x, y of a plate, or radius and slope of a knot" : "A line a folder";
  return {
    element,
    read: () => element.value,
    show: (stated, counts) => {
      element.value = stated === undefined ? "" : text(stated);
      element.placeholder = counts === undefined ? "" : text(counts);
      element.rows = Math.max(2, Math.min(8, element.value.split("\n").length));
    },
  };
}

/** Numbers of joints are typed in one field, with commas between: so they are copied, too. */
function field(key: FormKey, actions: ControlActions): Control {
  const { domain } = key;
  const numeric = domain.kind === "integer" || domain.kind === "number" || domain.kind === "number_above";
  const element = el("input", { set: { type: "text", inputmode: numeric ? "decimal" : "text", spellcheck: "false", autocomplete: "off" } });
  element.addEventListener("input", () => actions.typed());
  element.addEventListener("change", () => actions.commit());
  element.addEventListener("keydown", (event) => {
    if (event.key === "Enter") actions.commit();
    if (event.key === "Escape") actions.revert();
    if (!numeric || (event.key !== "ArrowUp" && event.key !== "ArrowDown")) return;
    event.preventDefault();
    const next = stepped(element.value === "" ? element.placeholder : element.value, event.key === "ArrowUp" ? 1 : -1, event.shiftKey, domain);
    if (next === null) return;
    element.value = next;
    actions.typed();
    actions.commit();
  });
  return {
    element,
    read: () => element.value,
    show: (stated, counts) => {
      const text = stated === undefined ? "" : valueText(stated);
      if (element.value !== text) element.value = text;
      element.placeholder = counts === undefined ? "none" : valueText(counts);
    },
  };
}

/** One key of the form. */
export class KeyRow {
  readonly element: HTMLElement;
  readonly key: FormKey;
  readonly #control: Control;
  readonly #error = el("p", { class: "field-error" });
  readonly #reset: HTMLButtonElement;
  readonly #onValue: (key: string, value: Value | null) => void;
  #stated: Value | undefined;
  #counts: Value | undefined;
  #refusal: string | null = null;
  #dirty = false;

  constructor(key: FormKey, onValue: (key: string, value: Value | null) => void) {
    this.key = key;
    this.#onValue = onValue;
    this.#control = controlFor(key, { typed: () => this.#typed(), commit: () => this.#commit(), revert: () => this.#revert() });
    const id = `key-${key.path.replace(/[^a-z0-9_]/gi, "-")}`;
    const input = this.#control.element;
    input.id = id;
    input.setAttribute("aria-describedby", `${id}-about ${id}-error`);
    this.#error.id = `${id}-error`;
    this.#reset = button({ class: "button bare-button", label: `Take ${key.path} out of the text${key.default === null ? "" : `: then ${valueText(key.default)} counts`}` }, () => {
      input.focus();
      this.#onValue(key.path, null);
    }, "take out");
    const name = FIRST.includes(key.path) ? key.path : key.path.slice(key.path.lastIndexOf(".") + 1);
    const given = key.default === null ? "" : `; ${valueText(key.default)} where it is not stated`;
    this.element = el(
      "div",
      { class: "key", set: { "data-key": key.path } },
      el("label", { set: { for: id } }, el("code", {}, name)),
      el("span", { class: "key-value" }, input, key.unit === "" || key.unit === "–" ? null : el("span", { class: "unit" }, key.unit), this.#reset),
      this.#error,
      el("p", { class: "key-about", id: `${id}-about` }, isolated(key.meaning), " ", el("span", { class: "key-range" }, isolated(`${key.expected}${given}`))),
    );
    this.#mark();
  }

  /** Shows what the text states and what counts, unless something is being typed here. */
  show(stated: Value | undefined, counts: Value | undefined, refusal: string | null): void {
    const same = sameOrNone(stated, this.#stated) && sameOrNone(counts, this.#counts);
    if (same && refusal === this.#refusal) return;
    this.#stated = stated;
    this.#counts = counts;
    this.#refusal = refusal;
    if (!same && !(this.#dirty && document.activeElement === this.#control.element)) this.#fill();
    this.#mark();
  }

  /** Whether a search finds it. */
  matches(words: readonly string[]): boolean {
    const text = `${this.key.path} ${this.key.meaning} ${this.key.unit}`.toLowerCase();
    return words.every((word) => text.includes(word) || text.includes(stem(word)));
  }

  focus(): void {
    this.#control.element.focus();
  }

  #fill(): void {
    this.#dirty = false;
    this.#control.show(this.#stated, this.#counts ?? this.key.default ?? undefined);
    this.#control.element.dataset["dirty"] = "false";
  }

  #mark(): void {
    const wrong = this.#dirty && this.#control.read() !== "" && "wrong" in readValue(this.key, this.#control.read());
    const words = wrong ? `Expected ${this.key.expected}.` : (this.#refusal ?? "");
    this.#error.replaceChildren(words === "" ? "" : isolated(words));
    this.#error.hidden = words === "";
    this.#control.element.setAttribute("aria-invalid", String(words !== ""));
    this.#reset.hidden = this.#stated === undefined;
    this.element.classList.toggle("stated", this.#stated !== undefined);
  }

  #typed(): void {
    this.#dirty = true;
    this.#control.element.dataset["dirty"] = "true";
    this.#mark();
  }

  #commit(): void {
    const text = this.#control.read();
    const textual = this.key.domain.kind === "text";
    if (text === "" && !textual) return this.#dirty ? this.#take(null) : undefined;
    const read = readValue(this.key, text);
    if ("wrong" in read) {
      this.#dirty = true;
      return this.#mark();
    }
    if (this.#stated !== undefined && sameValue(read.value, this.#stated)) return this.#revert();
    this.#take(read.value);
  }

  #take(value: Value | null): void {
    this.#dirty = false;
    this.#control.element.dataset["dirty"] = "false";
    if (value === null && this.#stated === undefined) return this.#revert();
    this.#onValue(this.key.path, value);
    this.#mark();
  }

  #revert(): void {
    this.#fill();
    this.#mark();
  }
}

function sameOrNone(a: Value | undefined, b: Value | undefined): boolean {
  return a === undefined || b === undefined ? a === b : sameValue(a, b);
}

/** A word without its ending, so that "washing" finds "wash". */
function stem(word: string): string {
  return word.length > 5 ? word.replace(/(ing|ed|es|s)$/, "") : word;
}

/** Keys that people change most: they are in front of all sections. */
const FIRST = ["wash.speed_m_s", "wash.lift_m", "wash.clearance_m", "wash.tilt_max_deg", "tool.sponge_radius_m", "tool.sponge_compression_m", "seed"];
const FIRST_NAME = "Most changed";

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
  readonly #search = el("input", { class: "key-search", set: { type: "search", placeholder: "Search all settings by name or meaning", "aria-label": "Search keys", autocomplete: "off", spellcheck: "false" } });
  readonly #none = el("p", { class: "summary", set: { role: "status" } });
  #shown: FormShown | null = null;

  constructor(keys: readonly FormKey[], onValue: (key: string, value: Value | null) => void) {
    this.#rows = keys.map((key) => new KeyRow(key, onValue));
    const sections = new Map<string, KeyRow[]>([[FIRST_NAME, []]]);
    for (const row of this.#rows) {
      const name = FIRST.includes(row.key.path) ? FIRST_NAME : row.key.path.slice(0, Math.max(0, row.key.path.lastIndexOf(".")));
      sections.set(name, [...(sections.get(name) ?? []), row]);
    }
    sections.get(FIRST_NAME)?.sort((a, b) => FIRST.indexOf(a.key.path) - FIRST.indexOf(b.key.path));
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
  const open = name === FIRST_NAME;
  const words = name === "" ? "Top level" : name;
  const title = el("summary", {}, words, open ? null : el("span", { class: "key-count" }, String(rows.length)));
  const fields = el("fieldset", {}, el("legend", { class: "spoken" }, words), ...rows.map(({ element }) => element));
  const made: Section = { element: el("details", { class: "key-section" }, title, fields), rows, open };
  made.element.open = open;
  title.addEventListener("click", () => {
    made.open = !made.element.open;
  });
  return made;
}

export class TextPanel {
  readonly element: HTMLElement;
  readonly #area = el("textarea", { class: "scenario-text", set: { spellcheck: "false", autocomplete: "off", autocapitalize: "off", wrap: "off", "aria-label": "The scenario as text (TOML)", "aria-describedby": "text-error text-hint" } });
  readonly #error = el("p", { class: "field-error", id: "text-error", set: { role: "alert" } });
  readonly #apply: HTMLButtonElement;
  readonly #onText: (text: string) => void;
  #text = "";
  #marked = "";

  constructor(onText: (text: string) => void) {
    this.#onText = onText;
    this.#apply = button({ class: "button text-button" }, () => this.#commit(), "Apply");
    const back = button({ class: "button text-button" }, () => this.#fill(), "Discard");
    this.#area.addEventListener("input", () => this.#touch());
    this.#area.addEventListener("change", () => this.#commit());
    this.#area.addEventListener("keydown", (event) => {
      if (event.key === "Enter" && (event.ctrlKey || event.metaKey)) this.#commit();
    });
    // Pressed before the text is left, which would apply it.
    back.addEventListener("pointerdown", (event) => event.preventDefault());
    const hint = el("p", { class: "summary", id: "text-hint" }, "Applied with Ctrl+Enter or when it is left. Comments and order stay when plates or keys change.");
    this.element = el("div", { class: "text-panel" }, hint, this.#area, this.#error, el("div", { class: "edit-tools" }, this.#apply, back));
  }

  /** Shows the text that counts, unless another is being typed; and what is wrong with it. */
  show(text: string, wrong: { words: string; line: number | null } | null, waiting: boolean): void {
    if (text !== this.#text) {
      const dirty = this.#dirty;
      this.#text = text;
      if (!dirty) this.#fill();
    }
    const words = wrong === null ? (waiting ? "Changes of the form are not in this text: they are refused, or on their way." : "") : `${wrong.line === null ? "" : `Line ${wrong.line}: `}${wrong.words}`;
    if (words === this.#marked) return;
    this.#marked = words;
    this.#error.replaceChildren(words === "" ? "" : isolated(words));
    this.#area.setAttribute("aria-invalid", String(wrong !== null));
    if (wrong !== null && wrong.line !== null && !this.#dirty) this.#select(wrong.line);
  }

  /** The browser's own line ends are not those of the file. */
  get #dirty(): boolean {
    return this.#area.value !== this.#text.replaceAll("\r\n", "\n").replaceAll("\r", "\n");
  }

  #touch(): void {
    this.#area.dataset["dirty"] = String(this.#dirty);
    this.#apply.classList.toggle("unsaved", this.#dirty);
  }

  #fill(): void {
    const { scrollTop, selectionStart, selectionEnd } = this.#area;
    this.#area.value = this.#text;
    this.#area.setSelectionRange(selectionStart, selectionEnd);
    this.#area.scrollTop = scrollTop;
    this.#touch();
  }

  #commit(): void {
    if (!this.#dirty) return;
    const text = this.#text.includes("\r\n") ? this.#area.value.replaceAll("\n", "\r\n") : this.#area.value;
    this.#text = text;
    this.#touch();
    this.#onText(text);
  }

  /** Selects a line and brings it into sight, without taking the focus. */
  #select(line: number): void {
    const lines = this.#area.value.split("\n");
    const from = lines.slice(0, line - 1).reduce((sum, one) => sum + one.length + 1, 0);
    this.#area.setSelectionRange(from, from + (lines[line - 1]?.length ?? 0));
    const height = this.#area.scrollHeight / Math.max(1, lines.length);
    this.#area.scrollTop = Math.max(0, (line - 4) * height);
  }
}

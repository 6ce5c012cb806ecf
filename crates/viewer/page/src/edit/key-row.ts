/** One key of the form. */
import { button, el, isolated } from "../shell/dom.ts";
import { readValue, valueText } from "./domain.ts";
import { controlFor, type Control } from "./fields.ts";
import type { Key, Value } from "./protocol.ts";
import { sameValue } from "./version.ts";

export class KeyRow {
  readonly element: HTMLElement;
  readonly key: Key;
  readonly #control: Control;
  readonly #error = el("p", { class: "field-error" });
  readonly #reset: HTMLButtonElement;
  readonly #onValue: (key: string, value: Value | null) => void;
  #stated: Value | undefined;
  #counts: Value | undefined;
  #refusal: string | null = null;
  #dirty = false;

  constructor(key: Key, onValue: (key: string, value: Value | null) => void) {
    this.key = key;
    this.#onValue = onValue;
    this.#control = controlFor(key, { typed: () => this.#typed(), commit: () => this.#commit(), revert: () => this.#revert() });
    const id = `key-${key.path.replace(/[^a-z0-9_]/gi, "-")}`;
    const input = this.#control.element;
    input.id = id;
    input.setAttribute("aria-describedby", `${id}-about ${id}-error`);
    this.#error.id = `${id}-error`;
    this.#reset = button({ class: "button bare-button", label: `Reset ${key.path}: take it out of the text` }, () => {
      input.focus();
      this.#onValue(key.path, null);
    }, "reset");
    const name = key.path.slice(key.path.lastIndexOf(".") + 1);
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

/** The scenario as text. */
import { button, el, isolated } from "../shell/dom.ts";

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

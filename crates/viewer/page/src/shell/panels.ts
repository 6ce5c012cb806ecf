/** The panels beside the scene: tabs where there is room beside it, sections that fold below it, all at once on huge screens. */
import { button, byId, el, icon } from "./dom.ts";

export interface Panel {
  id: string;
  title: string;
  content: HTMLElement;
  /** The panel came into sight. */
  onShow?: () => void;
}

type Mode = "tabs" | "fold" | "all";

interface Part extends Panel {
  tab: HTMLButtonElement;
  section: HTMLElement;
  fold: HTMLButtonElement;
  open: boolean;
}

export class Panels {
  readonly #root = byId("panels");
  readonly #parts: Part[];
  readonly #wide = matchMedia("(min-width: 880px)");
  readonly #huge = matchMedia("(min-width: 2500px)");
  readonly #tabs = el("div", { class: "tabs", set: { role: "tablist", "aria-label": "Panels" } });
  #chosen = 0;
  #printing = false;
  #started = false;
  readonly #onChange: (id: string) => void;

  constructor(panels: readonly Panel[], chosen: string | null, onChange: (id: string) => void) {
    this.#onChange = onChange;
    this.#parts = panels.map((panel, k) => this.#part(panel, k));
    this.#chosen = Math.max(0, panels.findIndex(({ id }) => id === chosen));
    const first = this.#parts[this.#chosen];
    if (first !== undefined) first.open = true;
    this.#tabs.append(...this.#parts.map(({ tab }) => tab));
    this.#tabs.addEventListener("keydown", (event) => this.#arrows(event));
    this.#root.replaceChildren(this.#tabs, ...this.#parts.map(({ section }) => section));
    for (const query of [this.#wide, this.#huge]) query.addEventListener("change", () => this.#arrange());
    this.#arrange();
  }

  /** Fills what is in sight: not before the scene has been drawn. */
  start(): void {
    this.#started = true;
    this.#arrange();
  }

  /** Whether a panel is in sight, as far as folding goes. */
  shows(id: string): boolean {
    return this.#parts.some((part) => part.id === id && !part.content.hidden);
  }

  show(id: string): void {
    const k = this.#parts.findIndex((part) => part.id === id);
    if (k < 0) return;
    this.#chosen = k;
    this.#parts[k]!.open = true;
    this.#arrange();
    this.#onChange(id);
  }

  /** Everything open, as paper cannot be folded out. */
  print(printing: boolean): void {
    this.#printing = printing;
    this.#arrange();
  }

  get #mode(): Mode {
    if (this.#printing || this.#huge.matches) return "all";
    return this.#wide.matches ? "tabs" : "fold";
  }

  #part(panel: Panel, k: number): Part {
    const content = el("div", { id: `panel-${panel.id}-content`, class: "panel-content" }, panel.content);
    const tab = button(
      { class: "tab", id: `tab-${panel.id}`, set: { role: "tab", "aria-controls": `panel-${panel.id}` } },
      () => this.show(panel.id),
      panel.title,
    );
    const fold = button({ class: "fold", set: { "aria-controls": content.id } }, () => this.#toggle(k), panel.title, icon("down"));
    const title = el("h2", { class: "panel-title", id: `title-${panel.id}` }, fold);
    const section = el("section", { class: "panel", id: `panel-${panel.id}` }, title, content);
    return { ...panel, content, tab, section, fold, open: false };
  }

  #toggle(k: number): void {
    const part = this.#parts[k]!;
    part.open = !part.open;
    if (part.open) this.#chosen = k;
    this.#arrange();
    if (part.open) this.#onChange(part.id);
  }

  #arrange(): void {
    const mode = this.#mode;
    this.#root.dataset["mode"] = mode;
    this.#tabs.hidden = mode !== "tabs";
    this.#parts.forEach((part, k) => {
      const chosen = k === this.#chosen;
      const open = mode === "all" || (mode === "tabs" ? chosen : part.open);
      part.section.hidden = mode === "tabs" && !chosen;
      part.section.setAttribute("role", mode === "tabs" ? "tabpanel" : "region");
      part.section.setAttribute("aria-labelledby", mode === "tabs" ? part.tab.id : `title-${part.id}`);
      part.tab.setAttribute("aria-selected", String(chosen));
      part.tab.tabIndex = chosen ? 0 : -1;
      part.fold.setAttribute("aria-expanded", String(open));
      part.fold.disabled = mode !== "fold";
      part.content.hidden = !open;
    });
    if (this.#started) for (const part of this.#parts) if (!part.content.hidden) part.onShow?.();
  }

  #arrows(event: KeyboardEvent): void {
    const count = this.#parts.length;
    const to = { ArrowRight: this.#chosen + 1, ArrowLeft: this.#chosen - 1, Home: 0, End: count - 1 }[event.key];
    if (to === undefined) return;
    event.preventDefault();
    event.stopPropagation();
    const part = this.#parts[(to + count) % count]!;
    this.show(part.id);
    part.tab.focus();
  }
}

/** The panel of the cell: what can be done with it, and its plates. */
import { button, el, isolated } from "../shell/dom.ts";
import type { Cell } from "./cell.ts";
import type { Selection } from "../scene/editing.ts";
import type { Centre } from "../scene/grab.ts";
import { plateState } from "./plate-state.ts";
import { Rows, type RowActions } from "./rows.ts";

export interface CellPanelActions extends RowActions {
  add(): void;
  all(): void;
  clearMap(): void;
}

export class CellPanel {
  readonly element: HTMLElement;
  readonly rows: Rows;
  readonly #all: HTMLButtonElement;
  readonly #findings = el("ul", { class: "plain findings" });
  readonly #standing = el("p", { class: "edit-standing" });
  readonly #mapWords = el("span", { set: { role: "status" } });
  readonly #map: HTMLElement;
  readonly #hint = el("p", { class: "summary" });
  #shown: unknown[] = [];

  constructor(actions: CellPanelActions) {
    this.rows = new Rows(actions);
    this.#all = button({ class: "button text-button", title: "Move and turn all plates together", set: { "aria-pressed": "false" } }, () => actions.all(), "All plates");
    this.#all.addEventListener("keydown", (event) => {
      if (event.key !== "Enter" && actions.key(event)) event.preventDefault();
    });
    const add = button({ class: "button text-button" }, () => actions.add(), "Add plate");
    const hide = button({ class: "button text-button", title: "Hide the map (Escape)" }, () => actions.clearMap(), "Hide the map");
    this.#map = el("div", { class: "map-words" }, this.#mapWords, hide);
    this.#map.hidden = true;
    this.element = el("div", { class: "cell-panel" }, this.#standing, this.#findings, this.#map, this.rows.element, el("div", { class: "edit-tools" }, add, this.#all), this.#hint);
  }

  show(cell: Cell, selected: Selection, mapWords: string | null): void {
    const { seen, answers, centres } = cell;
    const now = [seen.drawn, cell.standing.words, answers, centres, selected, mapWords, seen.preview];
    if (now.every((one, k) => one === this.#shown[k])) return;
    this.#shown = now;
    const names = seen.drawn?.plates ?? [];
    this.rows.show(centres.map((centre: Centre, k) => ({ name: names[k]?.name ?? `plate_${k}`, centre, state: plateState(answers, k) })), selected);
    // The header has room for a line only.
    const { kind, words } = cell.standing;
    const bad = kind === "refused" || kind === "failed" || kind === "lost" || kind === "unplanned" || kind === "not proved";
    this.#standing.hidden = !bad;
    this.#standing.replaceChildren(isolated(bad ? words : ""));
    this.#all.setAttribute("aria-pressed", String(selected === "all"));
    this.#findings.replaceChildren(...(seen.drawn?.findings ?? []).map(({ words }) => el("li", {}, isolated(words))));
    this.#map.hidden = mapWords === null;
    if (this.#mapWords.textContent !== mapWords) this.#mapWords.textContent = mapWords;
    const stuck = cell.unmoved();
    const hint = stuck !== null ? stuck : seen.drawn?.listed === false ? "These plates are drawn from a region by the seed: moving one lists them all where they are." : "Drag plates in the scene, or move them with the arrow keys; an obstacle once it is clicked.";
    if (this.#hint.textContent !== hint) this.#hint.textContent = hint;
  }
}

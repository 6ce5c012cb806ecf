/** The panel of the cell: what can be done with it, and its plates, each with what is known of it. */
import { millimetres, plateName } from "../format.ts";
import type { Selection } from "../scene/editing.ts";
import type { Centre } from "../scene/handles.ts";
import { button, el, icon, isolated, TextCell, toneIcon } from "../shell/dom.ts";
import type { Tone } from "../verdict.ts";
import { plateState, type PlateState } from "./answers.ts";
import type { Cell } from "./cell.ts";
import type { Commands } from "./commands.ts";
import { numberText, readNumber } from "./domain.ts";

/** What is done beside what `Commands` does. */
export interface PanelActions {
  /** Shows where a plate could be washed. */
  map(plate: number): void;
  clearMap(): void;
  /** Shows the way on after a stop with the joints as typed, or else at the moment shown. */
  recover(joints: string): void;
  clearRecovery(): void;
  /** A key on a row; whether it was of use. */
  key(event: KeyboardEvent): boolean;
}

export interface RowShown {
  name: string;
  centre: Centre;
  state: PlateState;
}

/** Coordinates farther than this are refused by every scenario [m]. */
const FARTHEST_M = 10;

class Row {
  readonly element: HTMLElement;
  readonly #plate: number;
  readonly #name = el("bdi", { class: "row-name" });
  readonly #sign = el("span", { class: "status" });
  readonly #inputs: [HTMLInputElement, HTMLInputElement];
  readonly #take: HTMLButtonElement;
  readonly #remove: HTMLButtonElement;
  readonly #nearest = new TextCell();
  readonly #why = el("div", { class: "row-why" });
  #shown: { tone: Tone; word: string; words: string; causes: readonly string[] } | null = null;
  #centre: Centre = [0, 0];

  constructor(plate: number, commands: Commands, actions: PanelActions) {
    this.#plate = plate;
    this.#inputs = [this.#input("x", 0, commands), this.#input("y", 1, commands)];
    this.#take = button({ class: "button text-button" }, () => {
      // The button goes with the place.
      this.element.focus();
      commands.take(plate);
    }, icon("target"), el("span", {}, this.#nearest.node));
    this.#remove = button({ class: "button bare-button", title: "Remove (Delete)" }, () => {
      this.element.focus();
      commands.remove(plate);
    }, icon("cross"));
    const map = button({ class: "button text-button", title: "Show where it could be washed, the others as they lie" }, () => actions.map(plate), "Where?");
    const places = el("div", { class: "row-places" }, ...this.#inputs.map((input, k) => el("label", {}, k === 0 ? "x" : "y", input)), el("span", { class: "unit" }, "m"), map, this.#remove);
    this.element = el("div", { class: "row", set: { tabindex: 0, role: "group" } }, el("div", { class: "row-head" }, this.#name, this.#sign), places, this.#why, this.#take);
    this.element.addEventListener("focusin", () => commands.select(plate));
    this.element.addEventListener("pointerdown", () => commands.select(plate));
    this.element.addEventListener("keydown", (event) => {
      // Here it is the focus that chooses the plate.
      const chooses = event.key.toLowerCase() === "n";
      if (event.target === this.element && !chooses && actions.key(event)) event.preventDefault();
    });
  }

  show({ name, centre, state }: RowShown, selected: boolean, several: boolean): void {
    if (this.#name.textContent !== name) {
      this.#name.textContent = name;
      this.#inputs.forEach((input, k) => input.setAttribute("aria-label", `${name}, ${k === 0 ? "x" : "y"} in metres`));
      this.#remove.setAttribute("aria-label", `Remove ${name}`);
    }
    this.#centre = centre;
    this.#inputs.forEach((input, k) => {
      if (document.activeElement !== input || input.dataset["dirty"] !== "true") this.#fill(input, k as 0 | 1);
    });
    this.element.classList.toggle("selected", selected);
    this.#remove.disabled = !several;
    const { nearest_m } = state;
    this.#take.hidden = nearest_m === undefined || nearest_m === null;
    if (nearest_m) this.#nearest.set(`Nearest place, ${millimetres(Math.hypot(nearest_m[0] - centre[0], nearest_m[1] - centre[1]), 0)} away`);
    this.#say(state);
  }

  #fill(input: HTMLInputElement, axis: 0 | 1): void {
    const text = numberText(Number(this.#centre[axis].toFixed(4)));
    if (input.value !== text) input.value = text;
    input.removeAttribute("aria-invalid");
    delete input.dataset["dirty"];
  }

  #say(state: PlateState): void {
    const { tone, word, words, nearest_m, searched_m } = state;
    const nowhere = nearest_m === null ? [`No other place within ${millimetres(searched_m, 0)}.`] : [];
    const causes = [...state.causes, ...nowhere];
    const now = { tone, word, words, causes };
    if (JSON.stringify(now) === JSON.stringify(this.#shown)) return;
    this.#shown = now;
    this.#sign.className = `status tone-${tone}`;
    this.#sign.replaceChildren(toneIcon(tone), word);
    this.element.className = this.element.className.replace(/ ?tone-\w+/g, "") + ` tone-${tone}`;
    const list = causes.length === 0 ? [] : [el("ul", { class: "plain" }, ...causes.map((cause) => el("li", {}, isolated(cause))))];
    this.#why.replaceChildren(...(words === "" ? [] : [el("p", {}, isolated(words))]), ...list);
    this.#why.hidden = words === "" && causes.length === 0;
    this.element.setAttribute("aria-label", `${this.#name.textContent}: ${word}`);
  }

  #input(name: string, axis: 0 | 1, commands: Commands): HTMLInputElement {
    const input = el("input", { class: "number", set: { type: "text", inputmode: "decimal", name, autocomplete: "off", spellcheck: "false" } });
    const read = (): number | null => {
      const value = readNumber(input.value);
      return value !== null && Math.abs(value) <= FARTHEST_M ? value : null;
    };
    const to = (value: number): void => {
      const centre: Centre = [...this.#centre];
      centre[axis] = value;
      commands.place(this.#plate, centre);
    };
    input.addEventListener("input", () => {
      input.dataset["dirty"] = "true";
      input.setAttribute("aria-invalid", String(read() === null));
    });
    input.addEventListener("change", () => {
      const value = read();
      if (value === null) return;
      delete input.dataset["dirty"];
      if (value !== Number(this.#centre[axis].toFixed(4))) to(value);
    });
    input.addEventListener("blur", () => this.#fill(input, axis));
    input.addEventListener("keydown", (event) => {
      if (event.key === "Escape") this.#fill(input, axis);
      if (event.key !== "ArrowUp" && event.key !== "ArrowDown") return;
      event.preventDefault();
      const step = event.altKey ? 0.001 : event.shiftKey ? 0.05 : 0.005;
      delete input.dataset["dirty"];
      to(Math.round(((read() ?? this.#centre[axis]) + (event.key === "ArrowUp" ? step : -step)) * 1e6) / 1e6);
    });
    return input;
  }
}

export class CellPanel {
  readonly element: HTMLElement;
  readonly #commands: Commands;
  readonly #actions: PanelActions;
  readonly #list = el("div", { class: "rows", set: { role: "group", "aria-label": "Plates" } });
  readonly #rows: Row[] = [];
  readonly #all: HTMLButtonElement;
  readonly #findings = el("ul", { class: "plain findings" });
  readonly #mapWords = el("span", { set: { role: "status" } });
  readonly #map: HTMLElement;
  readonly #recoveryWords = el("span", { set: { role: "status" } });
  readonly #recovery: HTMLElement;
  readonly #hint = el("p", { class: "summary" });
  #shown: unknown[] = [];

  constructor(commands: Commands, actions: PanelActions) {
    this.#commands = commands;
    this.#actions = actions;
    this.#all = button({ class: "button text-button", title: "Move and turn all plates together", set: { "aria-pressed": "false" } }, () => commands.toggleAll(), "All plates");
    this.#all.addEventListener("keydown", (event) => {
      if (event.key !== "Enter" && actions.key(event)) event.preventDefault();
    });
    const add = button({ class: "button text-button" }, () => commands.add(), "Add plate");
    const obstacle = button({ class: "button text-button", title: "Add a box that stands around; its size is in the text" }, () => commands.addObstacle(), "Add obstacle");
    const hide = button({ class: "button text-button", title: "Hide the map (Escape)" }, () => actions.clearMap(), "Hide the map");
    this.#map = el("div", { class: "map-words" }, this.#mapWords, hide);
    this.#map.hidden = true;
    const joints = el("input", { class: "joints", set: { type: "text", autocomplete: "off", spellcheck: "false", placeholder: "joints now, six numbers", "aria-label": "Joint positions where the arm stands, in degrees; empty for the moment shown" } });
    joints.addEventListener("keydown", (event) => {
      if (event.key === "Enter") actions.recover(joints.value);
    });
    const recover = button({ class: "button text-button", title: "After a stop: a proved motion home from these joints, or from the moment shown, and what is left to wash" }, () => actions.recover(joints.value), "Recover");
    const back = button({ class: "button text-button", title: "Show the plan again (Escape)" }, () => actions.clearRecovery(), "Back to the plan");
    this.#recovery = el("div", { class: "recovery-words" }, this.#recoveryWords, back);
    this.#recovery.hidden = true;
    const stop = el("div", { class: "row-places", set: { role: "group", "aria-label": "After a stop" } }, "After a stop", joints, el("span", { class: "unit" }, "°"), recover);
    this.element = el("div", { class: "cell-panel" }, this.#findings, this.#map, this.#list, el("div", { class: "edit-tools" }, add, obstacle, this.#all), this.#hint, stop, this.#recovery);
  }

  show(cell: Cell, selected: Selection, mapWords: string | null, recoveryWords: string | null): void {
    const { seen, answers, centres } = cell;
    const now = [seen.drawn, cell.standing.words, answers, centres, selected, mapWords, recoveryWords, seen.preview];
    if (now.every((one, k) => one === this.#shown[k])) return;
    this.#shown = now;
    this.#showRows(centres.map((centre, k) => ({ name: plateName(seen.drawn?.plates, k), centre, state: plateState(answers, k) })), selected);
    this.#all.setAttribute("aria-pressed", String(selected === "all"));
    this.#findings.replaceChildren(...(seen.drawn?.findings ?? []).map(({ words }) => el("li", {}, "Note: ", isolated(words))));
    this.#map.hidden = mapWords === null;
    if (this.#mapWords.textContent !== mapWords) this.#mapWords.textContent = mapWords;
    this.#recovery.hidden = recoveryWords === null;
    if (this.#recoveryWords.textContent !== recoveryWords) this.#recoveryWords.textContent = recoveryWords;
    const stuck = cell.unmoved();
    const drag = "Drag plates in the scene, or choose one with N and move it with the arrow keys; an obstacle once it is clicked.";
    const hint = stuck ?? (seen.drawn?.listed === false ? `${drag} The seed draws these plates from the region: moving one lists them all where they are.` : drag);
    if (this.#hint.textContent !== hint) this.#hint.textContent = hint;
  }
  /** Shows every plate. Rows stay what they are, and with them focus and what is being typed. */
  #showRows(list: readonly RowShown[], selected: Selection): void {
    while (this.#rows.length > list.length) this.#rows.pop()?.element.remove();
    while (this.#rows.length < list.length) {
      const row = new Row(this.#rows.length, this.#commands, this.#actions);
      this.#rows.push(row);
      this.#list.append(row.element);
    }
    list.forEach((shown, k) => this.#rows[k]!.show(shown, selected === "all" || selected === k, list.length > 1));
  }
}

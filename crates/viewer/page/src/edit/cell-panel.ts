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

interface RowShown {
  name: string;
  centre: Centre;
  /** Null of an obstacle. */
  state: PlateState | null;
  selected: boolean;
  /** Whether it can be taken away. */
  goes: boolean;
}

/** What is done with the thing of a row; with plates alone the last two. */
type RowActions = Pick<PanelActions, "key"> & { select(): void; place(centre: Centre): void; remove(): void; take?(): void; map?(): void };

/** Coordinates farther than this are refused by every scenario [m]. */
const FARTHEST_M = 10;

class Row {
  readonly element: HTMLElement;
  readonly #actions: RowActions;
  readonly #name = el("bdi", { class: "row-name" });
  readonly #sign = el("span", { class: "status" });
  readonly #inputs: [HTMLInputElement, HTMLInputElement];
  readonly #take: HTMLButtonElement;
  readonly #remove: HTMLButtonElement;
  readonly #nearest = new TextCell();
  readonly #why = el("div", { class: "row-why" });
  #shown: { tone: Tone; word: string; words: string; causes: readonly string[] } | null = null;
  #centre: Centre = [0, 0];

  constructor(actions: RowActions) {
    this.#actions = actions;
    this.#inputs = [this.#input("x", 0), this.#input("y", 1)];
    this.#take = button({ class: "button text-button" }, () => {
      // The button goes with the place.
      this.element.focus();
      actions.take?.();
    }, icon("target"), el("span", {}, this.#nearest.node));
    this.#remove = button({ class: "button bare-button", title: "Remove (Delete)" }, () => {
      this.element.focus();
      actions.remove();
    }, icon("cross"));
    const map = actions.map === undefined ? null : button({ class: "button text-button", title: "Show where it could be washed, the others as they lie" }, actions.map, "Where?");
    const places = el("div", { class: "row-places" }, ...this.#inputs.map((input, k) => el("label", {}, k === 0 ? "x" : "y", input)), el("span", { class: "unit" }, "m"), map, this.#remove);
    this.element = el("div", { class: "row", set: { tabindex: 0, role: "group" } }, el("div", { class: "row-head" }, this.#name, this.#sign), places, this.#why, this.#take);
    for (const type of ["focusin", "pointerdown"]) this.element.addEventListener(type, () => actions.select());
    this.element.addEventListener("keydown", (event) => {
      // Here it is the focus that chooses.
      const chooses = event.key.toLowerCase() === "n";
      if (event.target === this.element && !chooses && actions.key(event)) event.preventDefault();
    });
  }

  show({ name, centre, state, selected, goes }: RowShown): void {
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
    this.#remove.hidden = !goes;
    const nearest_m = state?.nearest_m;
    this.#take.hidden = nearest_m === undefined || nearest_m === null;
    if (nearest_m) this.#nearest.set(`Nearest place, ${millimetres(Math.hypot(nearest_m[0] - centre[0], nearest_m[1] - centre[1]), 0)} away`);
    if (state !== null) this.#say(state);
    else this.element.setAttribute("aria-label", name);
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
    const causes = [...state.causes.filter((cause) => !words.includes(cause)), ...nowhere];
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

  #input(name: string, axis: 0 | 1): HTMLInputElement {
    const input = el("input", { class: "number", set: { type: "text", inputmode: "decimal", name, autocomplete: "off", spellcheck: "false" } });
    const read = (): number | null => {
      const value = readNumber(input.value);
      return value !== null && Math.abs(value) <= FARTHEST_M ? value : null;
    };
    const to = (value: number): void => {
      const centre: Centre = [...this.#centre];
      centre[axis] = value;
      this.#actions.place(centre);
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
  readonly #bodyList = el("div", { class: "rows", set: { role: "group", "aria-label": "Obstacles" } });
  readonly #bodyRows: Row[] = [];
  /** The body of each of these rows. */
  #bodies: number[] = [];
  readonly #addObstacle: HTMLButtonElement;
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
    this.#addObstacle = button({ class: "button text-button", title: "Add a box that stands around; its size is in the text" }, () => commands.addObstacle(), "Add obstacle");
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
    this.element = el("div", { class: "cell-panel" }, this.#findings, this.#map, this.#list, this.#bodyList, el("div", { class: "edit-tools" }, add, this.#addObstacle, this.#all), this.#hint, stop, this.#recovery);
  }

  show(cell: Cell, selected: Selection, mapWords: string | null, recoveryWords: string | null): void {
    const { seen, answers, centres } = cell;
    const now = [seen.drawn, cell.standing.words, answers, centres, cell.put, selected, this.#commands.body, mapWords, recoveryWords, seen.preview];
    if (now.every((one, k) => one === this.#shown[k])) return;
    this.#shown = now;
    const plates = centres.map((centre, k) => ({ name: plateName(seen.drawn?.plates, k), centre, state: plateState(answers, k), selected: selected === "all" || selected === k, goes: centres.length > 1 }));
    const commands = this.#commands;
    const { key, map } = this.#actions;
    showRows(this.#list, this.#rows, plates, (plate) => new Row({
      key, select: () => commands.select(plate), place: (centre) => commands.place(plate, centre), remove: () => commands.remove(plate), take: () => commands.take(plate), map: () => map(plate),
    }));
    this.#showBodies(cell);
    this.#all.setAttribute("aria-pressed", String(selected === "all"));
    this.#findings.replaceChildren(...(seen.drawn?.findings ?? []).map(({ words }) => el("li", {}, "Note: ", isolated(words))));
    this.#map.hidden = mapWords === null;
    if (this.#mapWords.textContent !== mapWords) this.#mapWords.textContent = mapWords;
    this.#recovery.hidden = recoveryWords === null;
    if (this.#recoveryWords.textContent !== recoveryWords) this.#recoveryWords.textContent = recoveryWords;
    const stuck = cell.unmoved();
    const drag = "Drag plates in the scene, or choose one with N, or here, and move it with the arrow keys; an obstacle once it is clicked.";
    const hint = stuck ?? (seen.drawn?.listed === false ? `${drag} The seed draws these plates from the region: moving one lists them all where they are.` : drag);
    if (this.#hint.textContent !== hint) this.#hint.textContent = hint;
  }

  /** Shows every obstacle that is moved. */
  #showBodies(cell: Cell): void {
    const { drawn } = cell.seen;
    const commands = this.#commands;
    this.#bodies = (drawn?.moves?.bodies ?? []).flatMap(({ key }, body) => (key === null ? [] : [body]));
    const list = this.#bodies.flatMap((body) => {
      const [centre, name] = [cell.bodyAt(body), drawn?.surroundings.obstacles[body]?.name ?? "obstacle"];
      return centre === null ? [] : [{ name, centre, state: null, selected: commands.body === body, goes: commands.sectionOf(body) !== null }];
    });
    const at = (k: number): number => this.#bodies[k]!;
    showRows(this.#bodyList, this.#bodyRows, list, (k) => new Row({
      key: this.#actions.key, select: () => commands.selectBody(at(k)), place: (centre) => commands.placeBody(at(k), centre), remove: () => commands.removeBody(at(k)),
    }), this.#addObstacle);
    // Keys move what was just added.
    const added = this.#bodyRows[this.#bodies.indexOf(commands.added ?? -1)];
    if (added === undefined) return;
    commands.added = null;
    added.element.focus();
  }
}

/** Shows rows, which stay what they are, and with them focus and what is being typed. Where the focus was on a row that goes, it is on the last one that stays. */
function showRows(list: HTMLElement, rows: Row[], shown: readonly RowShown[], make: (k: number) => Row, otherwise: HTMLElement | null = null): void {
  while (rows.length > shown.length) {
    const gone = rows.pop()!.element;
    if (gone.contains(document.activeElement)) (rows.at(-1)?.element ?? otherwise)?.focus();
    gone.remove();
  }
  while (rows.length < shown.length) {
    const row = make(rows.length);
    rows.push(row);
    list.append(row.element);
  }
  shown.forEach((one, k) => rows[k]!.show(one));
}

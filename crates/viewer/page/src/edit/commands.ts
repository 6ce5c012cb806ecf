/** Commands of a live cell: what pointers, keys and buttons do to its plates. */
import { plateName } from "../format.ts";
import type { EditActions, Editing, Selection } from "../scene/editing.ts";
import { marksHeight } from "../scene/floor.ts";
import { type Centre, type Phase, stepped } from "../scene/handles.ts";
import { announce } from "../shell/dom.ts";
import type { View } from "../view.ts";
import type { CellDrawn } from "./answers.ts";
import type { Cell } from "./cell.ts";
import { onFloor, plateIndices, roomFor, shifted, turned } from "./placing.ts";
import type { ToolbarActions } from "./toolbar.ts";

/** Edges of a box that is added [m]. */
const BOX_M = [0.08, 0.08, 0.2] as const;

/** Directions in which an obstacle that is added is seen, of 24. */
const SEEN = 11;

/** Coordinates in words. */
function metres(place: readonly number[]): string {
  return place.map((c) => c.toFixed(3)).join(", ");
}

export class Commands implements EditActions {
  readonly #cell: Cell;
  readonly #scene: () => Editing | null;
  /** Of the canvas [CSS px]. */
  readonly #size: () => Centre;
  /** The axis that plates are turned about, seen from above [m]. */
  readonly #axis: () => Centre;
  readonly #changed: () => void;
  readonly #say: (words: string) => void;
  /** The body that is selected among those that stand around. */
  #body: number | null = null;
  /** The body that was added, until it is shown. */
  added: number | null = null;
  #selected: Selection = null;

  constructor(cell: Cell, view: () => View, scene: () => Editing | null, size: () => Centre, changed: () => void, say: (words: string) => void) {
    this.#cell = cell;
    this.#scene = scene;
    this.#size = size;
    this.#axis = () => {
      const [x, y] = view().arm.mount.position_m;
      return [x, y];
    };
    this.#changed = changed;
    this.#say = say;
  }

  /** Selects all plates, or no longer. */
  toggleAll(): void {
    this.select(this.#selected === "all" ? null : "all");
  }

  /** Whether there is something to move. */
  get active(): boolean {
    return this.#selected !== null || this.#body !== null;
  }

  get selected(): Selection {
    return this.#selected;
  }

  get body(): number | null {
    return this.#body;
  }

  select(plate: Selection): void {
    if (plate !== null) this.selectBody(null);
    if (plate === this.#selected) return;
    this.#selected = plate;
    this.#scene()?.select(plate);
    this.#changed();
  }

  selectBody(body: number | null): void {
    if (body === this.#body) return;
    const words = body === null ? null : this.#cell.seen.drawn?.moves?.bodies[body]?.words;
    if (words) return this.#say(words);
    this.#body = body;
    if (body !== null) {
      this.select(null);
      announce(`${this.#nameOf(body)} selected: drag it, or move it with the arrow keys`);
    }
    this.#scene()?.selectBody(body);
    this.#changed();
  }

  moveBody(body: number, centre_m: Centre, phase: Phase): void {
    if (phase === "cancel") return this.#cell.cancelDrag();
    if (phase !== "start") this.#cell.dragBody({ body, centre_m });
    if (phase === "end") this.#cell.drop(`Move ${this.#nameOf(body)}`);
  }

  mayMove(quiet = false): boolean {
    return this.#isFree(this.#cell.centres.length, quiet);
  }

  /** Whether so many plates can be where hands put them; says why not. */
  #isFree(count: number, quiet = false): boolean {
    const words = this.#cell.unmoved(count);
    if (words !== null && !quiet) this.#say(words);
    return words === null;
  }

  move(to: { plates: number[]; centres_m: Centre[] }, phase: Phase): void {
    if (phase === "cancel") return this.#cell.cancelDrag();
    const centres = this.#cell.centres.map((centre, k): Centre => to.centres_m[to.plates.indexOf(k)] ?? centre);
    if (phase !== "start") this.#cell.drag(centres);
    if (phase === "end") this.#cell.drop(this.#label("Move", to.plates));
  }

  /** Puts a plate where it can be washed. */
  take(plate: Selection): void {
    if (typeof plate !== "number" || !this.mayMove()) return;
    const nearest = this.#cell.answers.places.find((place) => place.plate === plate)?.nearest_m;
    if (!nearest) return;
    this.place(plate, nearest, "Take the nearest place of");
    announce(`${this.#plateName(plate)} put at ${metres(nearest)} m`);
  }

  place(plate: number, centre: Centre, verb = "Move"): void {
    if (!this.mayMove()) return;
    const centres = this.#cell.centres.map((one, k): Centre => (k === plate ? centre : one));
    this.#cell.place(centres, this.#label(verb, [plate]), `place ${plate}`);
  }

  /** Selects the next of all plates and of the obstacles that are moved, or the one before. */
  next(step: 1 | -1): void {
    const plates = this.#cell.centres.length;
    const bodies = (this.#cell.seen.drawn?.moves?.bodies ?? []).flatMap(({ key }, body) => (key === null ? [] : [body]));
    const count = plates + bodies.length;
    if (count === 0) return;
    const at = typeof this.#selected === "number" ? this.#selected : this.#body === null ? -1 : plates + bodies.indexOf(this.#body);
    const next = (at < 0 && step === -1 ? count - 1 : at + step + count) % count;
    if (next >= plates) return this.selectBody(bodies[next - plates]!);
    this.select(next);
    announce(`${this.#plateName(next)} selected`);
  }

  /** Shifts what is selected to the right and upwards on the screen. */
  shift(right_m: number, up_m: number): void {
    const plates = this.#plates;
    if (this.#body !== null) return this.#shiftBody(this.#body, onFloor(right_m, up_m, this.#ahead()));
    if (!this.mayMove()) return;
    const [dx_m, dy_m] = onFloor(right_m, up_m, this.#ahead());
    this.#cell.place(shifted(this.#cell.centres, plates, dx_m, dy_m), this.#label("Move", plates), `move ${this.#selected}`);
    this.#sayPlace();
  }

  #shiftBody(body: number, [dx_m, dy_m]: Centre): void {
    const at = this.#cell.bodyAt(body);
    if (at === null) return;
    this.placeBody(body, shifted([at], [0], dx_m, dy_m)[0]!);
    announce(metres(this.#cell.bodyAt(body)!));
  }

  placeBody(body: number, centre_m: Centre): void {
    this.#cell.placeBody({ body, centre_m }, `Move ${this.#nameOf(body)}`, `move body ${body}`);
  }

  /** The section of the text that has a body among the obstacles; null for another body, which cannot be taken away. */
  sectionOf(body: number): string | null {
    return /^obstacle\[\d+\]/.exec(this.#cell.seen.drawn?.moves.bodies[body]?.key ?? "")?.[0] ?? null;
  }

  removeBody(body: number): void {
    const [section, name] = [this.sectionOf(body), this.#nameOf(body)];
    if (section === null) return this.#say(`${name} is no obstacle: it goes in the text.`);
    this.selectBody(null);
    this.#cell.change([{ key: section, value: null }], `Remove ${name}`);
    this.#say(`${name} removed.`);
  }

  /** Removes what is selected. */
  removeSelected(): void {
    if (this.#body !== null) this.removeBody(this.#body);
    else this.remove(this.#selected);
  }

  turn(angle_rad: number): void {
    const plates = this.#plates;
    if (plates.length === 0 || !this.mayMove()) return;
    this.#cell.place(turned(this.#cell.centres, plates, this.#axis(), angle_rad), this.#label("Turn", plates), `turn ${this.#selected}`);
    this.#sayPlace();
  }

  add(): void {
    const { drawn } = this.#cell.seen;
    if (drawn === null || !this.#isFree(this.#cell.centres.length + 1)) return;
    const room = this.#roomIn(drawn);
    this.#cell.place([...this.#cell.centres, room], "Add a plate");
    this.select(this.#cell.centres.length - 1);
    announce(`plate ${this.#cell.centres.length} added at ${metres(room)} m`);
  }

  /** Adds a box that stands where the plates do, beside them. */
  addObstacle(): void {
    const { drawn } = this.#cell.seen;
    if (drawn === null) return;
    const { obstacles } = drawn.surroundings;
    // Towards whoever looks, so that the arm does not hide it.
    const [x, y] = this.#ahead();
    const room = this.#roomIn(drawn, obstacles.map(({ pose: { position_m: [x, y] } }): Centre => [x, y]), Math.atan2(-y, -x), SEEN);
    const name = Array.from(obstacles, (_, k) => `box ${k + 1}`).find((free) => !obstacles.some((one) => one.name === free)) ?? `box ${obstacles.length + 1}`;
    const at = [...room, stepped(marksHeight(drawn) + BOX_M[2] / 2, 1e3)];
    this.#cell.append(`[[obstacle]]\nname = "${name}"\nshape = "box"\nsize_m = [${BOX_M.join(", ")}]\nat_m = [${at.join(", ")}]\n`, `Add ${name}`);
    this.selectBody(obstacles.length);
    this.added = obstacles.length;
    this.#say(`${name} added at ${metres(at)} m: drag it, or move it with the arrow keys; Delete removes it.`);
  }

  /** A free place near the arm, beside all plates and other places; in the front, and how far to either side. */
  #roomIn(drawn: CellDrawn, others: readonly Centre[] = [], front_rad = 0, ways?: number): Centre {
    const keepOff = (drawn.surroundings.base_circle_m ?? 0.2) + 0.01;
    return roomFor([...this.#cell.centres, ...others], Math.max(0.001, ...drawn.radius_m), this.#axis(), keepOff, front_rad, ways);
  }

  remove(plate: Selection): void {
    if (typeof plate !== "number") return;
    const centres = this.#cell.centres.filter((_, k) => k !== plate);
    if (centres.length === 0 || centres.length === this.#cell.centres.length) return;
    if (!this.#isFree(centres.length)) return;
    const label = this.#label("Remove", [plate]);
    this.select(this.#selected === "all" ? "all" : null);
    this.#cell.place(centres, label);
    announce(`plate ${plate + 1} removed; ${centres.length} left, numbered anew`);
  }

  #nameOf(body: number): string {
    return this.#cell.seen.drawn?.surroundings.obstacles[body]?.name ?? "the obstacle";
  }

  get #plates(): number[] {
    return plateIndices(this.#selected, this.#cell.centres.length);
  }

  #sayPlace(): void {
    const centre = typeof this.#selected === "number" ? this.#cell.centres[this.#selected] : undefined;
    announce(centre === undefined ? "All plates moved" : metres(centre));
  }

  /** Where upwards on the screen points, seen from above; along x where there is no scene. */
  #ahead(): Centre {
    const [width, height] = this.#size();
    const [from, to] = [0.52, 0.48].map((share) => this.#scene()?.toPlane(0.5 * width, share * height, 0));
    return from && to ? [to[0] - from[0], to[1] - from[1]] : [1, 0];
  }

  #label(verb: string, plates: readonly number[]): string {
    const [only] = plates;
    if (plates.length !== 1 || only === undefined) return `${verb} ${plates.length} plates`;
    return `${verb} ${this.#plateName(only)}`;
  }

  #plateName(plate: number): string {
    return plateName(this.#cell.seen.drawn?.plates, plate);
  }
}

export interface EditKeys extends ToolbarActions {
  /** A key on the scene; whether it was of use. */
  plate(event: KeyboardEvent): boolean;
}

/** Whether the focus is where something is being typed, which undoes that itself. */
function isTyping(event: KeyboardEvent): boolean {
  const target = event.target;
  return target instanceof HTMLElement && target.matches("input, textarea") && target.dataset["dirty"] === "true";
}

export function listenToEditKeys(canvas: HTMLCanvasElement, keys: EditKeys): void {
  canvas.tabIndex = 0;
  canvas.setAttribute("role", "application");
  canvas.setAttribute("aria-description", "A plate that is selected is moved with the arrow keys and turned about the arm with R; the list of plates does the same.");
  canvas.addEventListener("keydown", (event) => {
    if (keys.plate(event)) event.preventDefault();
  });
  document.addEventListener("keydown", (event) => {
    if (event.defaultPrevented || event.altKey || !(event.ctrlKey || event.metaKey)) return;
    const key = event.key.toLowerCase();
    if (key === "s") keys.save();
    else if (key === "z" && !isTyping(event)) (event.shiftKey ? keys.redo : keys.undo)();
    else if (key === "y" && !isTyping(event)) keys.redo();
    else return;
    event.preventDefault();
  });
}

const STEP_M = 0.005;
const COARSE_M = 0.05;
const FINE_M = 0.001;
const TURN_RAD = Math.PI / 180;

const ARROWS: Readonly<Record<string, readonly [number, number]>> = {
  ArrowLeft: [-1, 0],
  ArrowRight: [1, 0],
  ArrowUp: [0, 1],
  ArrowDown: [0, -1],
};

/** For the help. */
export const PLATE_KEYS: [string, string][] = [
  ["Drag", "a plate, or an obstacle once it is clicked: moves it; the ring’s knob turns a plate about the arm"],
  ["N", "in the scene: select the next plate or obstacle; with Shift the one before"],
  ["↑ ↓ ← →", "on a plate or an obstacle: move it 5 mm along x or y, whichever the arrow points along on the screen; with Shift 50 mm, with Alt 1 mm"],
  ["R", "on a plate: turn it 1° about the arm’s axis, counter-clockwise; with Shift clockwise"],
  ["Enter", "on a plate: take the nearest place that can be washed"],
  ["Delete", "on a plate or an obstacle: remove it"],
  ["Escape", "give up what is being dragged; then select nothing"],
  ["Ctrl+Z Ctrl+Y", "undo, redo"],
  ["Ctrl+S", "save"],
];

/** Does what a key says of plates; whether it says anything. Where none is selected, keys are the film's. */
export function plateKey(event: KeyboardEvent, commands: Commands, cancel: () => void): boolean {
  if (event.ctrlKey || event.metaKey) return false;
  if (event.key.toLowerCase() === "n" && !event.altKey) {
    commands.next(event.shiftKey ? -1 : 1);
    return true;
  }
  if (!commands.active) return false;
  const arrow = ARROWS[event.key];
  if (arrow !== undefined) {
    const step = event.altKey ? FINE_M : event.shiftKey ? COARSE_M : STEP_M;
    commands.shift(arrow[0] * step, arrow[1] * step);
    return true;
  }
  if (event.altKey) return false;
  const meanings: Record<string, () => void> = {
    r: () => commands.turn(event.shiftKey ? -TURN_RAD : TURN_RAD),
    delete: () => commands.removeSelected(),
    backspace: () => commands.removeSelected(),
    enter: () => commands.take(commands.selected),
    escape: cancel,
  };
  const does = meanings[event.key.toLowerCase()];
  does?.();
  return does !== undefined;
}

/** Brings the scene up to what is known of the cell: every call changes only what is different. */
import type { View } from "../view.ts";
import type { Answers, CellDrawn, PlanLine, ProofLine } from "./answers.ts";
import type { Cell } from "./cell.ts";
import type { Centre } from "../scene/grab.ts";
import type { Editing } from "../scene/editing.ts";
import { ViewMaker } from "./view.ts";

/** For how long the film of before stays while a plan is waited for [ms]. */
const PATIENCE_MS = 600;

export class CellShown {
  readonly #scene: () => Editing | null;
  readonly #replace: (view: View) => void;
  readonly #maker: ViewMaker;
  #view: View;
  #cell: CellDrawn | null = null;
  /** Since when a cell waits for its plan [ms]. */
  #since = 0;
  #waits: CellDrawn | null = null;
  #centres: readonly Centre[] | null = null;
  #put: Cell["put"] = null;
  #chances: Answers["preview"] | null = null;
  #unplanned: Answers["unplanned"] = null;
  #places: Answers["places"] = [];

  constructor(first: View, scene: () => Editing | null, replace: (view: View) => void) {
    this.#view = first;
    this.#maker = new ViewMaker(first);
    this.#scene = scene;
    this.#replace = replace;
  }

  get view(): View {
    return this.#view;
  }

  update(cell: Cell, now: number): void {
    this.#updateView(cell, now);
    this.#updatePlaces(cell);
    this.#updateWords(cell);
  }

  /** Plan and proof as soon as they are there; the cell alone where it has none, or where one takes long. */
  #updateView(cell: Cell, now: number): void {
    const asked = cell.planned;
    const { answers } = asked ?? cell;
    if (answers.cell !== null && answers.plan !== null) return this.#show(answers.cell, cell, answers.plan, answers.proof);
    if (answers.cell !== null && answers.unplanned !== null) return this.#show(answers.cell, cell, null, null);
    const { drawn } = cell.seen;
    if (drawn === null || drawn === this.#cell) return;
    if (this.#waits === null) this.#since = now;
    this.#waits = drawn;
    const patient = this.#cell !== null && now - this.#since < PATIENCE_MS;
    if (!patient && !cell.dragging && answers.refused === null) this.#show(drawn, cell, null, null);
  }

  #show(drawn: CellDrawn, cell: Cell, plan: PlanLine | null, proof: ProofLine | null): void {
    const view = this.#maker.of(drawn, cell.seen.arm, plan, proof);
    this.#waits = null;
    this.#cell = drawn;
    if (view === this.#view) return;
    this.#view = view;
    this.#centres = null;
    this.#put = null;
    this.#replace(view);
  }

  /** Plates and a body where they were put, while what is drawn has them elsewhere. */
  #updatePlaces(cell: Cell): void {
    if (cell.put !== this.#put) {
      this.#put = cell.put;
      this.#scene()?.previewBody(cell.put);
    }
    const elsewhere = cell.centres.length === this.#view.plates.length && cell.centres.some((centre, k) => !isAt(this.#view, k, centre));
    const centres = elsewhere ? cell.centres : null;
    if (centres === this.#centres) return;
    this.#centres = centres;
    this.#scene()?.preview(centres === null ? null : centres.map(([x, y]) => [x, y]));
  }

  #updateWords(cell: Cell): void {
    const { answers, seen, dragging } = cell;
    if (seen.preview !== this.#chances) {
      this.#chances = seen.preview;
      this.#scene()?.chances(seen.preview?.plates ?? []);
    }
    const unplanned = dragging ? null : answers.unplanned;
    if (unplanned !== this.#unplanned) {
      this.#unplanned = unplanned;
      this.#scene()?.offending(unplanned?.plates.map(({ plate, free_m, dead_m }) => ({ plate, free_m, dead_m })) ?? []);
      if (unplanned !== null) this.#scene()?.chances(unplanned.plates.map(({ plate, proved }) => ({ plate, chance: proved ? "unwashable" : "unclear" })));
      else if (seen.preview === null) this.#scene()?.chances([]);
    }
    const places = unplanned === null ? NONE : answers.places;
    if (places === this.#places) return;
    this.#places = places;
    this.#scene()?.ghosts(places.flatMap(({ plate, nearest_m }) => (nearest_m === null ? [] : [{ plate, centre_m: nearest_m }])));
  }
}

const NONE: Answers["places"] = [];

function isAt(view: View, plate: number, [x, y]: Centre): boolean {
  const at = view.plates[plate]?.pose.position_m;
  return at !== undefined && Math.abs(at[0] - x) < 1e-9 && Math.abs(at[1] - y) < 1e-9;
}

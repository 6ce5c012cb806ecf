/** Brings page and scene up to what is known of the cell: every call changes only what is different. */
import type { Editing } from "../scene/editing.ts";
import type { Centre } from "../scene/handles.ts";
import type { View } from "../view.ts";
import { type Answers, blamedBodies, type CellDrawn, type PlanLine, type ProofLine } from "./answers.ts";
import type { Cell } from "./cell.ts";

/** Makes views out of answers. The same answers give the same view, and the same arm the same object. */
export class ViewMaker {
  readonly #version: string;
  #arm: View["arm"];
  #made: { cell: CellDrawn; plan: PlanLine | null; proof: ProofLine | null; view: View } | null = null;

  /** `first`: what the page came with. */
  constructor(first: View) {
    this.#version = first.version;
    this.#arm = first.arm;
  }

  /** The cell, with its plan and proof as far as there are. */
  of(cell: CellDrawn, arm: CellDrawn["arm"], plan: PlanLine | null, proof: ProofLine | null): View {
    const made = this.#made;
    if (made !== null && made.cell === cell && made.plan === plan && made.proof === proof) return made.view;
    if (arm !== null && arm.id === cell.arm_id) this.#arm = arm.arm;
    const view: View = {
      format: "platewash-view/2",
      version: this.#version,
      heading: plan?.heading ?? cell.heading,
      certificate: proof?.certificate ?? null,
      arm: this.#arm,
      tool: cell.tool,
      surroundings: cell.surroundings,
      plates: cell.plates,
      paths: plan?.paths ?? NONE,
      segments: plan?.segments ?? NONE,
      motion: plan?.motion ?? null,
      pose_rad: cell.pose_rad,
      clearance: plan?.clearance ?? null,
      coverage: (plan?.coverage ?? []).map((one) => withProof(one, proof)),
      dirt: NONE,
      execution: null,
      beside: null,
      live: null,
    };
    this.#made = { cell, plan, proof, view };
    return view;
  }
}

/** The same object each time, for those who ask what is different. */
const NONE: never[] = [];

function withProof(coverage: View["coverage"][number], proof: ProofLine | null): View["coverage"][number] {
  const proved = proof?.proved.find(({ plate }) => plate === coverage.plate)?.at_least;
  return proved === undefined ? coverage : { ...coverage, proved };
}

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
  #blamed = "";

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
    const blamed = dragging || this.#cell === null ? NONE : blamedBodies(answers, this.#cell);
    if (String(blamed) !== this.#blamed) {
      this.#blamed = String(blamed);
      this.#scene()?.refuse(blamed);
    }
    const places = unplanned === null ? NONE : answers.places;
    if (places === this.#places) return;
    this.#places = places;
    this.#scene()?.ghosts(places.flatMap(({ plate, nearest_m }) => (nearest_m === null ? [] : [{ plate, centre_m: nearest_m }])));
  }
}

function isAt(view: View, plate: number, [x, y]: Centre): boolean {
  const at = view.plates[plate]?.pose.position_m;
  return at !== undefined && Math.abs(at[0] - x) < 1e-9 && Math.abs(at[1] - y) < 1e-9;
}

/** The live cell: the scenario with its history, what is being changed in it, and what was answered. Knows no page. */
import type { Centre } from "../scene/handles.ts";
import { standing, type Activity, type Answers, type Seen, type Standing } from "./answers.ts";
import { Asker, type Asked, type AskerSettings, type Timing } from "./asker.ts";
import { changed, History, sameVersion, type Edit, type Step, type Version } from "./history.ts";
import { carrying, placing, putting, together, unmoved, type Put } from "./placing.ts";

/** Changes of one thing that follow each other within this are one step [ms]. */
export const BURST_MS = 1000;

export interface CellSettings extends AskerSettings {
  steps: readonly Step[];
  at: number;
  /** Anything has changed. */
  onChange: () => void;
}

interface Drag {
  from: Version;
  to: Version;
  /** Where plates were before, and the body that had been put somewhere. */
  were: readonly Centre[];
  had: Put | null;
}

interface Burst {
  name: string;
  at: number;
  until: number;
  from: Version;
}

export class Cell {
  readonly #settings: CellSettings;
  readonly #history: History;
  readonly #asker: Asker;
  #drag: Drag | null = null;
  #burst: Burst | null = null;
  /** Where plates were put, until whoever plans has drawn them there. */
  #centres: readonly Centre[] | null = null;
  /** Where a body was put that stands around, until whoever plans has drawn it there. */
  #put: Put | null = null;

  constructor(settings: CellSettings) {
    this.#settings = settings;
    this.#history = new History(settings.steps, settings.at);
    this.#asker = new Asker(settings, {
      version: () => this.version,
      moving: () => this.dragging,
      answered: (asked) => this.#adopt(asked),
      changed: () => settings.onChange(),
    });
  }

  /** Asks about what there is. */
  start(): void {
    this.#ask();
  }

  get history(): History {
    return this.#history;
  }

  /** What counts now: that of a drag while there is one. */
  get version(): Version {
    return this.#drag?.to ?? this.#history.version;
  }

  /** The scenario as far as it is written out. */
  get text(): string {
    return this.version.text;
  }

  get dragging(): boolean {
    return this.#drag !== null;
  }

  /** What there is to show. */
  get seen(): Readonly<Seen> {
    return this.#asker.seen;
  }

  /** Where plates are [m]. */
  get centres(): readonly Centre[] {
    return this.#centres ?? this.seen.drawn?.centres_m ?? [];
  }

  /** The body that was put somewhere else than it is drawn; null for none. */
  get put(): Put | null {
    return this.#put;
  }

  /** Where a body is that stands around [m]; null where that is not known. */
  bodyAt(body: number): Centre | null {
    if (this.#put?.body === body) return this.#put.centre_m;
    const [x, y] = this.seen.drawn?.moves?.bodies[body]?.at_m ?? [];
    return x === undefined || y === undefined ? null : [x, y];
  }

  /** Why so many plates cannot be where hands would put them; null where they can. */
  unmoved(count = this.centres.length): string | null {
    return unmoved(this.seen.drawn?.moves?.plates, count);
  }

  /** What was answered about the version that counts. */
  get answers(): Answers {
    return this.#asker.answers;
  }

  /** What planning has said last, perhaps of a moment ago while the mouse moves. */
  get planned(): Asked | null {
    return this.#asker.planned;
  }

  get timings(): Timing[] {
    return structuredClone(this.#asker.timings);
  }

  get state(): Activity {
    return this.#asker.state;
  }

  get standing(): Standing {
    const { lost } = this.#asker;
    return lost === null ? standing(this.answers) : { kind: "lost", words: `${lost.message} Trying again; nothing is lost here.` };
  }

  /** Whether every word about the version that counts was said. */
  get settled(): boolean {
    return this.state === "idle";
  }

  /** Changes keys. Changes of the same `burst` that follow each other closely are one step. */
  change(edits: readonly Edit[], label: string, burst: string | null = null): void {
    this.#endDrag();
    const now = this.#settings.time.now();
    const before = this.#burst;
    const goesOn = burst !== null && before?.name === burst && now <= before.until && before.at === this.#history.at;
    const from = goesOn ? before.from : this.#history.version;
    if (goesOn) this.#history.amend(changed(this.#history.version, edits));
    else this.#history.commit(changed(from, edits), label);
    // Where it is back at its start there is no step of it to go on with.
    const stepped = !sameVersion(this.#history.version, from);
    this.#burst = burst === null || !stepped ? null : { name: burst, at: this.#history.at, until: now + BURST_MS, from };
    this.#ask();
  }

  /** Another scenario. */
  setText(text: string, label: string): void {
    this.#endDrag();
    this.#burst = null;
    if (this.#history.commit({ text, edits: [] }, label)) this.#elsewhere();
  }

  /** Adds lines at the end of the text. */
  append(lines: string, label: string): void {
    this.#endDrag();
    this.#burst = null;
    const { text, edits } = this.#history.version;
    const end = text.includes("\r\n") ? "\r\n" : "\n";
    if (this.#history.commit({ text: `${text.trimEnd()}${end}${end}${lines.replaceAll("\n", end)}`, edits }, label)) this.#ask();
  }

  /** Goes a step back; false where there is none. */
  undo(): boolean {
    this.cancelDrag();
    const went = this.#history.undo();
    if (went) this.#elsewhere();
    return went;
  }

  /** Goes a step forth; false where there is none. */
  redo(): boolean {
    this.cancelDrag();
    const went = this.#history.redo();
    if (went) this.#elsewhere();
    return went;
  }

  /** Plates are somewhere else; the others exactly where they are. */
  place(centres: readonly Centre[], label: string, burst: string | null = null): void {
    if (centres.length === 0 || this.unmoved(centres.length) !== null) return;
    const { to, edits } = this.#moves(centres);
    this.#centres = to;
    this.change(edits, label, burst);
  }

  /** A body that stands around is somewhere else. */
  placeBody(put: Put, label: string, burst: string | null = null): void {
    const edits = putting(this.seen.drawn?.moves?.bodies[put.body], put.centre_m);
    if (edits.length === 0) return;
    this.#put = put;
    this.change(edits, label, burst);
  }

  /** Plates are on their way. */
  drag(centres: readonly Centre[]): void {
    if (this.unmoved(centres.length) !== null) return;
    const { to, edits } = this.#moves(centres);
    this.#carry(edits);
    this.#centres = to;
  }

  /** Where plates go, and the changes that put them there, with what holds them. */
  #moves(centres: readonly Centre[]): { to: readonly Centre[]; edits: Edit[] } {
    const { moves, centres_m } = this.seen.drawn ?? {};
    const to = together(moves?.plates, this.centres, centres);
    // Bodies are where they were drawn, with the plates as they were then.
    const held = carrying(moves?.bodies ?? [], centres_m ?? [], to, (body) => this.bodyAt(body), this.#drag?.were ?? centres_m);
    return { to, edits: [...placing(moves?.plates, to), ...held] };
  }

  /** A body that stands around is on its way. */
  dragBody(put: Put): void {
    const edits = putting(this.seen.drawn?.moves?.bodies[put.body], put.centre_m);
    if (edits.length === 0) return;
    this.#carry(edits);
    this.#put = put;
  }

  #carry(edits: readonly Edit[]): void {
    const { from, were, had } = this.#drag ?? { from: this.#history.version, were: this.centres, had: this.#put };
    this.#drag = { from, were, had, to: changed(from, edits) };
    this.#burst = null;
    this.#asker.moved();
    this.#settings.onChange();
  }

  /** They were dropped: one step. */
  drop(label: string): void {
    const drag = this.#drag;
    if (drag === null) return;
    this.#drag = null;
    this.#asker.stopLooking();
    this.#history.commit(drag.to, label);
    this.#ask();
  }

  /** They are where they were. */
  cancelDrag(): void {
    const drag = this.#drag;
    if (drag === null) return;
    this.#drag = null;
    this.#asker.stopLooking();
    this.#elsewhere();
    if (this.planned?.answers.cell == null) [this.#centres, this.#put] = [drag.were, drag.had];
  }

  /** A change from elsewhere ends a drag where it is. */
  #endDrag(): void {
    if (this.#drag !== null) this.drop("Move plates");
  }

  #elsewhere(): void {
    this.#burst = null;
    [this.#centres, this.#put] = [null, null];
    this.#ask();
  }

  #ask(): void {
    this.#asker.ensure();
    this.#settings.onChange();
  }

  /** What whoever plans has written out is what stands in the history, and where it has drawn plates they are. */
  #adopt(asked: Asked): void {
    const { scenario, cell } = asked.answers;
    if (scenario !== null && (scenario.text !== asked.version.text || asked.version.edits.length > 0)) {
      this.#history.settle({ text: scenario.text, edits: [] });
      asked.version = this.#history.version;
    }
    if (cell !== null) [this.#centres, this.#put] = [null, null];
  }
}

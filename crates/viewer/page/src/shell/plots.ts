/** The plots of a plan and of what was made of it. */
import { jointShares, recordedTipSpeed, shares, tipSpeed, type Curves } from "../curves.ts";
import type { Palette } from "../palette.ts";
import type { Player } from "../player.ts";
import { el, button } from "./dom.ts";
import { Plot, type Level, type Line, type PlotGroup, type PlotSpec, type Trace } from "./plot.ts";

/** Joints 4 to 6 are dashed, so that colours are not all that tells them from 1 to 3. */
const JOINT_LINES: Line[] = Array.from({ length: 6 }, (_, j) => ({
  label: `J${j + 1}`,
  colour: (palette: Palette) => palette.joints[j]!,
  ...(j < 3 ? {} : { dash: [5, 3] }),
}));
const PLANNED: Line = { label: "planned", colour: (palette) => palette.planned };
const EXECUTED: Line = { label: "executed", colour: (palette) => palette.executed };

const BOTH_LIMITS: Level[] = [
  { value: 100, label: "limit", bad: "above" },
  { value: -100, label: "limit", bad: "below" },
];
/** Clearances beyond this tell nothing: so many margins, at least so many millimetres. */
const MARGINS = 10;
const FAR_MM = 100;
/** Shares beyond this would flatten all others [% of limit]. */
const CUT: [number, number] = [-250, 250];
/** Least time between two changes of figures: faster than this nobody reads [ms]. */
const READABLE_MS = 100;
/** Time between two drawings of curves that grow [ms]. */
const GROW_MS = 500;

function shareSpec(id: string, title: string, curves: Curves): PlotSpec {
  const traces = [{ ...curves, lines: JOINT_LINES }];
  return { id, title, unit: "% of limit", decimals: 0, scale: 100, traces, levels: BOTH_LIMITS, range: [-100, 100], cut: CUT };
}

function empty(lines: Line[]): Trace {
  return { times: new Float64Array(0), curves: lines.map(() => new Float64Array(0)), lines };
}

export class Plots {
  readonly element = el("div", { class: "plots" });
  readonly #player: Player;
  #group: PlotGroup;
  readonly #reset: HTMLButtonElement;
  #plots: { spec: PlotSpec; plot: Plot; grow: (() => Trace[]) | null }[] | null = null;
  #updated = Number.NEGATIVE_INFINITY;
  /** Samples that are drawn. */
  #grown = 0;
  #growing = false;
  #old = false;

  constructor(player: Player, palette: () => Palette, seek: (t: number) => void) {
    this.#player = player;
    const zoom = (span: [number, number] | null): void => {
      for (const { plot } of this.#plots ?? []) plot.zoom(span);
      this.#reset.hidden = span === null;
    };
    this.#reset = button({ class: "button text-button" }, () => zoom(null), "Show all of it");
    this.#reset.hidden = true;
    this.#group = { duration: player.duration, segments: player.view.segments, palette, seek, zoom };
    new ResizeObserver(() => this.#fit()).observe(this.element);
  }

  /** The player shows another document. Curves take longer than a frame: the old ones stay, faint, until they are asked for again. */
  replace(): void {
    this.#old = true;
    this.element.classList.add("old");
    this.#group = { ...this.#group, duration: this.#player.duration, segments: this.#player.view.segments };
  }

  /** Whether what is drawn is of another document. */
  get old(): boolean {
    return this.#old;
  }

  /** Makes and draws what has not been drawn, now that it is in sight. */
  show(): void {
    if (this.#plots === null || this.#old) this.#make();
    this.#fit();
    this.update(0, true);
  }

  /** Moves the playheads; figures follow now and then, and when they are asked for. */
  update(now: number, anew: boolean): void {
    const early = !anew && now >= this.#updated && now - this.#updated < READABLE_MS;
    if (!early) this.#updated = now;
    for (const { plot } of this.#plots ?? []) {
      plot.move(this.#player.time);
      if (!early) plot.showValues();
    }
  }

  /** Adds what a live run has brought, now and then; between frames, as it takes longer than one should. */
  grow(): void {
    const count = this.#player.recording?.count ?? 0;
    if (this.#plots === null || count === this.#grown || this.#growing) return;
    this.#growing = true;
    setTimeout(() => {
      this.#growing = false;
      this.#grown = this.#player.recording?.count ?? 0;
      for (const { plot, grow } of this.#plots ?? []) if (grow !== null) plot.setTraces(grow());
      this.update(0, true);
    }, GROW_MS);
  }

  recolour(): void {
    for (const { plot } of this.#plots ?? []) plot.recolour();
  }

  /** Draws at this width, for paper; null for that of the panel. */
  print(width: number | null): void {
    if (width !== null && (this.#plots === null || this.#old)) this.#make();
    for (const { plot } of this.#plots ?? []) plot.draw(width ?? undefined);
    this.update(0, true);
  }

  #fit(): void {
    for (const { plot } of this.#plots ?? []) {
      if (plot.drawn) plot.resize();
      else plot.draw();
    }
  }

  #make(): void {
    this.#old = false;
    this.element.classList.remove("old");
    for (const { plot } of this.#plots ?? []) plot.destroy();
    const made = [...this.#planned(), ...this.#executed()];
    this.#plots = made.map(({ spec, grow }) => ({ spec, grow, plot: new Plot(spec, this.#group) }));
    this.#reset.hidden = true;
    const words = made.length === 0 ? "Nothing moves: there is no plan." : "Click to go there, drag to look closer. Sampled to look at, not the proof.";
    const head = el("div", { class: "plots-head" }, el("p", { class: "summary" }, words), this.#reset);
    this.element.replaceChildren(head, ...this.#plots.map(({ plot }) => plot.element));
    this.#grown = this.#player.recording?.count ?? 0;
  }

  #planned(): { spec: PlotSpec; grow: (() => Trace[]) | null }[] {
    const { motion, clearances, view } = this.#player;
    const specs: { spec: PlotSpec; grow: (() => Trace[]) | null }[] = [];
    if (motion !== null) {
      const joints = jointShares(motion, view.arm.joints);
      specs.push({ spec: shareSpec("position", "Joint position", joints.position), grow: null });
      specs.push({ spec: shareSpec("speed", "Joint speed", joints.speed), grow: null });
      if (joints.acceleration !== null) {
        specs.push({ spec: shareSpec("acceleration", "Joint acceleration", joints.acceleration), grow: null });
      }
      specs.push(this.#tipSpeed({ ...tipSpeed(motion, view.arm, view.tool), lines: [PLANNED] }));
    }
    if (clearances !== null) {
      const trace = { times: clearances.times, curves: [clearances.distances], lines: [{ ...PLANNED, label: "smallest" }] };
      const margin = 1000 * clearances.margin;
      const levels: Level[] = [{ value: margin, label: "margin", bad: "below" }];
      const cut: [number, number] = [Number.NEGATIVE_INFINITY, Math.max(FAR_MM, MARGINS * margin)];
      const range: [number, number] = [0, Math.max(1, 2 * margin)];
      specs.push({
        spec: { id: "clearance", title: "Smallest clearance", unit: "mm", decimals: 1, scale: 1000, traces: [trace], levels, range, cut },
        grow: null,
      });
    }
    return specs;
  }

  #tipSpeed(planned: Trace): { spec: PlotSpec; grow: (() => Trace[]) | null } {
    const { recording, view } = this.#player;
    const executed = (): Trace => ({ ...recordedTipSpeed(recording!.times, recording!.positions, view.arm, view.tool), lines: [EXECUTED] });
    const traces = recording === null ? [planned] : [planned, executed()];
    return {
      spec: { id: "tip-speed", title: "Tip speed", unit: "m/s", decimals: 3, scale: 1, traces, levels: [], range: [0, 0.05] },
      grow: recording === null ? null : () => [planned, executed()],
    };
  }

  #executed(): { spec: PlotSpec; grow: (() => Trace[]) | null }[] {
    const { recording, view } = this.#player;
    if (recording === null) return [];
    const error = (): Trace => ({ times: recording.times, curves: [recording.errors], lines: [EXECUTED] });
    const specs: { spec: PlotSpec; grow: (() => Trace[]) | null }[] = [
      {
        spec: { id: "error", title: "Tip off the plan", unit: "mm", decimals: 3, scale: 1000, traces: [error()], levels: [], range: [0, 0.001] },
        grow: () => [error()],
      },
    ];
    const torque = this.#torque(view.execution?.torque_limit_n_m ?? null);
    return torque === null ? specs : [...specs, torque];
  }

  #torque(limits: readonly number[] | null): { spec: PlotSpec; grow: (() => Trace[]) | null } | null {
    const recording = this.#player.recording;
    const live = this.#player.phase !== null;
    if (recording === null || (recording.torques.length === 0 && !live)) return null;
    const trace = (): Trace => ({ ...shares(recording.times, recording.torques, limits ?? [1, 1, 1, 1, 1, 1]), lines: JOINT_LINES });
    const traces = [recording.torques.length === 0 ? empty(JOINT_LINES) : trace()];
    const grow = (): Trace[] => [trace()];
    if (limits !== null) return { spec: { ...shareSpec("torque", "Joint torque", traces[0]!), traces }, grow };
    return { spec: { id: "torque", title: "Joint torque", unit: "N m", decimals: 2, scale: 1, traces, levels: [], range: [-1, 1] }, grow };
  }
}

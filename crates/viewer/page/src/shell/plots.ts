/** The plots of a plan and of what was made of it, linked: one cursor, one stretch of time, one playhead. */
import uPlot from "uplot";
import { jointShares, recordedTipSpeed, shares, tipSpeed, valueAt, type Curves } from "../curves.ts";
import { fixed } from "../format.ts";
import type { Palette } from "../palette.ts";
import type { Player } from "../player.ts";
import { button, el, TextCell } from "./dom.ts";

interface Line {
  label: string;
  colour: (palette: Palette) => string;
  /** The same as a custom property. */
  property: string;
  /** So that lines are told apart without colour. */
  dash?: number[];
}

/** A horizontal line that means something, and which side of it is beyond a limit. */
interface Level {
  value: number;
  label: string;
  bad: "above" | "below";
}

/** Curves over times of their own. */
interface Trace extends Curves {
  lines: Line[];
}

interface Spec {
  id: string;
  title: string;
  unit: string;
  decimals: number;
  /** What values are multiplied by for the unit. */
  scale: number;
  /** What there is to draw by now. */
  traces: () => Trace[];
  levels?: Level[];
  /** What the axis shows at least. */
  range: [number, number];
  /** What lies beyond these is cut off. */
  cut?: [number, number];
}

interface Plot {
  spec: Spec;
  traces: Trace[];
  figure: HTMLElement;
  box: HTMLElement;
  playhead: HTMLElement;
  /** What is cut off, in words. */
  peak: TextCell;
  chart: uPlot;
}

/** Joints 4 to 6 are dashed, so that colours are not all that tells them from 1 to 3. */
const JOINT_LINES: Line[] = Array.from({ length: 6 }, (_, j) => ({
  label: `J${j + 1}`,
  colour: (palette: Palette) => palette.joints[j]!,
  property: `--joint-${j}`,
  ...(j < 3 ? {} : { dash: [5, 3] }),
}));
const PLANNED: Line = { label: "planned", colour: (palette) => palette.planned, property: "--planned" };
const EXECUTED: Line = { label: "executed", colour: (palette) => palette.executed, property: "--executed" };

const HEIGHT_PX = 132;
/** Until there is a place for it [px]. */
const WIDTH_PX = 300;
/** Plots narrower than this are not drawn [px]. */
const NARROWEST_PX = 40;
/** Clearances beyond this tell nothing: so many margins, at least so many millimetres. */
const MARGINS = 10;
const FAR_MM = 100;
/** Least time between two changes of figures: faster than this nobody reads [ms]. */
const READABLE_MS = 100;
/** Time between two drawings of curves that grow [ms]. */
const GROW_MS = 500;

/** Shares of limits; those beyond the cut would flatten all others. */
function shareSpec(id: string, title: string, curves: () => Curves): Spec {
  const levels: Level[] = [{ value: 100, label: "limit", bad: "above" }, { value: -100, label: "limit", bad: "below" }];
  const traces = (): Trace[] => [{ ...curves(), lines: JOINT_LINES }];
  return { id, title, unit: "% of limit", decimals: 0, scale: 100, traces, levels, range: [-100, 100], cut: [-250, 250] };
}

/** The plots that there are for what the player shows. */
function specsOf({ motion, clearances, recording, view, phase }: Player): Spec[] {
  const specs: Spec[] = [];
  if (motion !== null) {
    const joints = jointShares(motion, view.arm.joints);
    const { acceleration } = joints;
    specs.push(shareSpec("position", "Joint position", () => joints.position), shareSpec("speed", "Joint speed", () => joints.speed));
    if (acceleration !== null) specs.push(shareSpec("acceleration", "Joint acceleration", () => acceleration));
    const planned = { ...tipSpeed(motion, view.arm, view.tool), lines: [PLANNED] };
    const traces = (): Trace[] => {
      if (recording === null) return [planned];
      return [planned, { ...recordedTipSpeed(recording.times, recording.positions, view.arm, view.tool), lines: [EXECUTED] }];
    };
    specs.push({ id: "tip-speed", title: "Tip speed", unit: "m/s", decimals: 3, scale: 1, traces, range: [0, 0.05] });
  }
  if (clearances !== null) {
    const traces = (): Trace[] => [{ times: clearances.times, curves: [clearances.distances], lines: [{ ...PLANNED, label: "smallest" }] }];
    const margin = 1000 * clearances.margin;
    const levels: Level[] = [{ value: margin, label: "margin", bad: "below" }];
    const cut: [number, number] = [Number.NEGATIVE_INFINITY, Math.max(FAR_MM, MARGINS * margin)];
    const range: [number, number] = [0, Math.max(1, 2 * margin)];
    specs.push({ id: "clearance", title: "Smallest clearance", unit: "mm", decimals: 1, scale: 1000, traces, levels, range, cut });
  }
  if (recording === null) return specs;
  const errors = (): Trace[] => [{ times: recording.times, curves: [recording.errors], lines: [EXECUTED] }];
  specs.push({ id: "error", title: "Tip off the plan", unit: "mm", decimals: 3, scale: 1000, traces: errors, range: [0, 0.001] });
  if (recording.torques.length === 0 && phase === null) return specs;
  const limits = view.execution?.torque_limit_n_m ?? null;
  const torques = (): Curves => {
    const times = recording.torques.length === 0 ? new Float64Array(0) : recording.times;
    return shares(times, recording.torques, limits ?? [1, 1, 1, 1, 1, 1]);
  };
  const spec = shareSpec("torque", "Joint torque", torques);
  const { id, title, traces } = spec;
  specs.push(limits !== null ? spec : { id, title, traces, unit: "N m", decimals: 2, scale: 1, range: [-1, 1] });
  return specs;
}

/** Data as uPlot wants them: one list of times, gaps where a trace has no point. */
function aligned(traces: readonly Trace[], scale: number): uPlot.AlignedData {
  const scaled = traces.map(({ times, curves }): uPlot.AlignedData => [times, ...curves.map((values) => values.map((value) => value * scale))]);
  return scaled.length === 1 ? scaled[0]! : uPlot.join(scaled);
}

/** A line's look in the legend, as CSS background. */
function sample({ property, dash }: Line): string {
  return dash === undefined ? `var(${property})` : `linear-gradient(to right, var(${property}) 0 4px, transparent 4px 7px, var(${property}) 7px)`;
}

export class Plots {
  readonly element = el("div", { class: "plots" });
  readonly #player: Player;
  readonly #palette: () => Palette;
  readonly #seek: (t: number) => void;
  readonly #reset = button({ class: "button text-button" }, () => this.#zoom(null), "Show all of it");
  #plots: Plot[] | null = null;
  /** The stretch of time that is shown [s]; null for all of it. */
  #span: [number, number] | null = null;
  #updated = Number.NEGATIVE_INFINITY;
  /** Samples that are drawn. */
  #grown = 0;
  #growing = false;
  #old = false;

  constructor(player: Player, palette: () => Palette, seek: (t: number) => void) {
    this.#player = player;
    this.#palette = palette;
    this.#seek = seek;
    new ResizeObserver(() => this.#fit(null)).observe(this.element);
  }

  /** The player shows another document. Curves take longer than a frame: the old ones stay, faint, until they are asked for again. */
  replace(): void {
    this.#old = true;
    this.element.classList.add("old");
  }

  /** Makes what has not been made, now that it is in sight. */
  show(): void {
    if (this.#plots === null || this.#old) this.#make();
    this.#fit(null);
    this.update(0, true);
  }

  /** Moves the playheads; figures follow now and then, and when they are asked for. */
  update(now: number, anew: boolean): void {
    const early = !anew && now >= this.#updated && now - this.#updated < READABLE_MS;
    if (!early) this.#updated = now;
    for (const { chart, playhead } of this.#plots ?? []) {
      this.#place(playhead, chart);
      if (!early) chart.setLegend({ idx: 0 }, false);
    }
  }

  #place(playhead: HTMLElement, chart: uPlot): void {
    const left = chart.valToPos(this.#player.time, "x");
    playhead.style.transform = `translateX(${left >= 0 && left <= chart.over.clientWidth + 0.5 ? left.toFixed(1) : -10}px)`;
  }

  /** Adds what a live run has brought, now and then; between frames, as it takes longer than one should. */
  grow(): void {
    const { recording } = this.#player;
    if (recording === null || this.#plots === null || recording.count === this.#grown || this.#growing) return;
    this.#growing = true;
    setTimeout(() => {
      this.#growing = false;
      this.#grown = recording.count;
      for (const plot of this.#plots ?? []) {
        plot.traces = plot.spec.traces();
        plot.chart.setData(aligned(plot.traces, plot.spec.scale), false);
        this.#describe(plot);
      }
      this.#zoom(this.#span);
    }, GROW_MS);
  }

  recolour(): void {
    for (const { chart } of this.#plots ?? []) chart.redraw(false);
  }

  /** Draws at this width, for paper; null for that of the panel. */
  print(width: number | null): void {
    if (width !== null && (this.#plots === null || this.#old)) this.#make();
    this.#fit(width);
    this.update(0, true);
  }

  #fit(width: number | null): void {
    for (const { box, chart } of this.#plots ?? []) {
      const wide = width ?? box.clientWidth;
      if (wide >= NARROWEST_PX && wide !== chart.width) chart.setSize({ width: wide, height: HEIGHT_PX });
    }
  }

  #zoom(span: [number, number] | null): void {
    this.#span = span;
    this.#reset.hidden = span === null;
    for (const { chart } of this.#plots ?? []) chart.setScale("x", { min: 0, max: this.#player.duration });
    this.update(0, true);
  }

  #make(): void {
    this.#old = false;
    this.element.classList.remove("old");
    for (const { chart } of this.#plots ?? []) chart.destroy();
    this.#plots = specsOf(this.#player).map((spec) => this.#plotOf(spec));
    this.#zoom(null);
    const hint = "Click to go there, drag to look closer. Sampled to look at, not the proof.";
    const words = el("p", { class: "summary" }, this.#plots.length === 0 ? "Nothing moves: there is no plan." : hint);
    this.element.replaceChildren(el("div", { class: "plots-head" }, words, this.#reset), ...this.#plots.map(({ figure }) => figure));
    this.#grown = this.#player.recording?.count ?? 0;
  }

  #plotOf(spec: Spec): Plot {
    const peak = new TextCell();
    const title = el("h3", {}, spec.title, " ", el("span", { class: "plot-unit" }, spec.unit, peak.node));
    const [caption, box] = [el("figcaption", {}, title), el("div", { class: "plot-box", set: { role: "img" } })];
    const traces = spec.traces();
    const many = traces.flatMap(({ lines }) => lines).length > 2;
    const figure = el("figure", { class: many ? "plot plot-many" : "plot", id: `plot-${spec.id}` }, caption, box);
    const playhead = el("div", { class: "plot-playhead" });
    const plot = { spec, traces, figure, box, playhead, peak };
    const chart = new uPlot(this.#options(plot, caption), aligned(traces, spec.scale), box);
    chart.over.append(playhead);
    chart.over.addEventListener("click", () => this.#seek(chart.posToVal(chart.cursor.left ?? 0, "x")));
    this.#describe(plot);
    return Object.assign(plot, { chart });
  }

  /** In words, for those who cannot see it. */
  #describe({ spec, traces, box, peak }: Omit<Plot, "chart">): void {
    const { title, unit, scale, decimals, levels = [], cut: [floor, ceiling] = [Number.NEGATIVE_INFINITY, Number.POSITIVE_INFINITY] } = spec;
    let [low, high] = [Number.POSITIVE_INFINITY, Number.NEGATIVE_INFINITY];
    for (const values of traces.flatMap(({ curves }) => curves)) {
      for (const value of values) {
        if (value < low) low = value;
        if (value > high) high = value;
      }
    }
    const span = low <= high ? `from ${fixed(low * scale, decimals)} to ${fixed(high * scale, decimals)} ${unit}` : "without values";
    const limits = levels.map((level) => `, ${level.label} ${fixed(level.value, decimals)} ${unit}`).join("");
    box.setAttribute("aria-label", `${title} over time, ${span}${limits}`);
    peak.set(low * scale < floor || high * scale > ceiling ? `, cut: ${span}` : "");
  }

  #options(plot: Omit<Plot, "chart">, caption: HTMLElement): uPlot.Options {
    const { decimals, scale, range: [least, most], cut: [floor, ceiling] = [Number.NEGATIVE_INFINITY, Number.POSITIVE_INFINITY] } = plot.spec;
    const lines = plot.traces.flatMap((trace) => trace.lines.map((line, curve) => ({ line, trace: plot.traces.indexOf(trace), curve })));
    const [ink, line] = [() => this.#palette().muted, () => this.#palette().line];
    const axis = { stroke: ink, grid: { stroke: line, width: 1 }, ticks: { show: false }, font: "11px system-ui, sans-serif" };
    const yRange = (_: uPlot, low: number | null, high: number | null): [number, number] => {
      const [from, to] = [Math.max(floor, Math.min(least, low ?? least)), Math.min(ceiling, Math.max(most, high ?? most))];
      const air = 0.04 * (to - from);
      return [from === 0 ? 0 : from - air, to + air];
    };
    return {
      width: WIDTH_PX,
      height: HEIGHT_PX,
      padding: [6, 8, 0, 0],
      // Figures are those at the playhead, wherever the cursor is.
      legend: { mount: (_, table) => caption.append(table), markers: { width: 0, fill: (_, k) => sample(lines[k - 1]!.line) } },
      scales: { x: { time: false, range: () => this.#span ?? [0, this.#player.duration] }, y: { range: yRange } },
      axes: [{ ...axis, size: 22, gap: 2, space: 46 }, { ...axis, size: 44, gap: 4, space: 24 }],
      series: [
        {},
        ...lines.map(({ line: { label, colour, dash }, trace, curve }) => ({
          label,
          stroke: () => colour(this.#palette()),
          width: 1.25,
          points: { show: false },
          spanGaps: true,
          value: () => fixed(valueAt(plot.traces[trace]!, curve, this.#player.time) * scale, decimals),
          ...(dash === undefined ? {} : { dash }),
        })),
      ],
      cursor: {
        y: false,
        points: { show: false },
        sync: { key: "platewash" },
        drag: { x: true, y: false, setScale: false },
        bind: { dblclick: () => () => (this.#zoom(null), null) },
      },
      hooks: {
        drawAxes: [(chart) => this.#drawGround(chart, plot.spec.levels ?? [])],
        draw: [(chart) => this.#place(plot.playhead, chart)],
        setSelect: [(chart) => this.#select(chart)],
      },
    };
  }

  #select(chart: uPlot): void {
    const { left, width } = chart.select;
    chart.setSelect({ left: 0, top: 0, width: 0, height: 0 }, false);
    if (width >= 6) this.#zoom([chart.posToVal(left, "x"), chart.posToVal(left + width, "x")]);
  }

  /** Stretches of washing, limits and what is beyond them. */
  #drawGround(chart: uPlot, levels: readonly Level[]): void {
    const { ctx, bbox: { left, top, width, height } } = chart;
    const palette = this.#palette();
    ctx.save();
    ctx.beginPath();
    ctx.rect(left, top, width, height);
    ctx.clip();
    ctx.globalAlpha = 0.07;
    ctx.fillStyle = palette.segments.wash;
    for (const { kind, t_start_s, t_end_s } of this.#player.view.segments) {
      const from = chart.valToPos(t_start_s, "x", true);
      if (kind === "wash") ctx.fillRect(from, top, chart.valToPos(t_end_s, "x", true) - from, height);
    }
    ctx.fillStyle = ctx.strokeStyle = palette.limit;
    ctx.lineWidth = Math.max(1, devicePixelRatio);
    ctx.setLineDash([4 * devicePixelRatio, 3 * devicePixelRatio]);
    for (const { value, bad } of levels) {
      const y = chart.valToPos(value, "y", true);
      ctx.globalAlpha = 0.1;
      ctx.fillRect(left, y, width, bad === "above" ? top - y : top + height - y);
      ctx.globalAlpha = 1;
      ctx.beginPath();
      ctx.moveTo(left, y);
      ctx.lineTo(left + width, y);
      ctx.stroke();
    }
    ctx.restore();
  }
}

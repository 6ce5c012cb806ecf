/** One plot over time, linked with the others: one cursor, one stretch of time, one playhead. */
import uPlot from "uplot";
import { valueAt, type Curves } from "../curves.ts";
import { fixed } from "../format.ts";
import { indexBefore } from "../knots.ts";
import type { Palette } from "../palette.ts";
import type { Segment } from "../view.ts";
import { el, TextCell } from "./dom.ts";

export interface Line {
  label: string;
  colour: (palette: Palette) => string;
  /** So that lines are told apart without colour. */
  dash?: number[];
}

/** A horizontal line that means something. */
export interface Level {
  value: number;
  label: string;
  /** Which side of it is beyond a limit. */
  bad: "above" | "below";
}

/** Curves over times of their own; values are multiplied by `scale` for the unit. */
export interface Trace extends Curves {
  lines: Line[];
}

export interface PlotSpec {
  id: string;
  title: string;
  unit: string;
  decimals: number;
  scale: number;
  traces: Trace[];
  levels: Level[];
  /** What the axis shows at least. */
  range: [number, number];
  /** What lies beyond these is cut off. */
  cut?: [number, number];
}

/** What plots have in common. */
export interface PlotGroup {
  duration: number;
  segments: readonly Segment[];
  palette(): Palette;
  seek(t: number): void;
  /** Shows a stretch of time in all plots; null for all of it. */
  zoom(span: [number, number] | null): void;
}

const HEIGHT_PX = 132;
const SYNC = "platewash";

/** Data as uPlot wants them: one list of times, gaps where a trace has no point. */
function aligned(spec: PlotSpec): uPlot.AlignedData {
  const scaled = spec.traces.map((trace): uPlot.AlignedData => {
    const curves = trace.curves.map((values) => values.map((value) => value * spec.scale));
    return [trace.times, ...curves] as unknown as uPlot.AlignedData;
  });
  const [first] = scaled;
  if (first === undefined) return [[]];
  return scaled.length === 1 ? first : uPlot.join(scaled);
}

export class Plot {
  readonly element: HTMLElement;
  readonly #spec: PlotSpec;
  readonly #group: PlotGroup;
  readonly #box = el("div", { class: "plot-box" });
  readonly #playhead = el("div", { class: "plot-playhead" });
  readonly #values: { cell: TextCell; trace: Trace; curve: number }[] = [];
  readonly #samples: { sample: HTMLElement; line: Line }[] = [];
  readonly #hints: number[];
  readonly #peak = new TextCell();
  #plot: uPlot | null = null;
  #span: [number, number] | null = null;
  #time = 0;

  constructor(spec: PlotSpec, group: PlotGroup) {
    this.#spec = spec;
    this.#group = group;
    this.#hints = spec.traces.map(() => 0);
    const unit = spec.unit === "" ? null : el("span", { class: "plot-unit" }, spec.unit);
    this.#box.setAttribute("role", "img");
    this.element = el(
      "figure",
      { class: "plot", id: `plot-${spec.id}` },
      el("figcaption", {}, el("h3", {}, spec.title, " ", unit, el("span", { class: "plot-unit" }, this.#peak.node)), this.#legend()),
      this.#box,
    );
    this.#describe();
  }

  /** Draws anew at the width that there is. */
  draw(width = this.#box.clientWidth): void {
    if (width < 40) return;
    this.#plot?.destroy();
    this.#plot = new uPlot(this.#options(width), aligned(this.#spec), this.#box);
    this.#plot.over.append(this.#playhead);
    this.#plot.over.addEventListener("click", () => {
      const left = this.#plot?.cursor.left ?? -1;
      if (this.#plot !== null && left >= 0) this.#group.seek(this.#plot.posToVal(left, "x"));
    });
    this.#place();
  }

  /** Takes it out of the plots that share a cursor. */
  destroy(): void {
    this.#plot?.destroy();
    this.#plot = null;
  }

  resize(): void {
    const width = this.#box.clientWidth;
    if (this.#plot === null || this.#plot.width === width) return;
    if (width < 40) return;
    this.#plot.setSize({ width, height: HEIGHT_PX });
    this.#place();
  }

  get drawn(): boolean {
    return this.#plot !== null;
  }

  /** Other curves in place of those that there are. */
  setTraces(traces: Trace[]): void {
    this.#spec.traces.forEach((trace, k) => {
      trace.times = traces[k]?.times ?? trace.times;
      trace.curves = traces[k]?.curves ?? trace.curves;
    });
    this.#plot?.setData(aligned(this.#spec), false);
    this.#plot?.setScale("x", this.#xRange());
    this.#describe();
  }

  zoom(span: [number, number] | null): void {
    this.#span = span;
    this.#plot?.setScale("x", this.#xRange());
    this.#place();
  }

  /** Moves the playhead. */
  move(t: number): void {
    this.#time = t;
    this.#place();
  }

  /** Shows the values at the playhead. */
  showValues(): void {
    const t = this.#time;
    this.#spec.traces.forEach((trace, k) => {
      this.#hints[k] = indexBefore(trace.times, trace.times.length, t, this.#hints[k]!);
    });
    for (const { cell, trace, curve } of this.#values) {
      const k = this.#hints[this.#spec.traces.indexOf(trace)]!;
      cell.set(fixed(valueAt(trace, curve, t, k) * this.#spec.scale, this.#spec.decimals));
    }
  }

  #xRange(): { min: number; max: number } {
    const [min, max] = this.#span ?? [0, this.#group.duration];
    return { min, max };
  }

  #place(): void {
    if (this.#plot === null) return;
    const left = this.#plot.valToPos(this.#time, "x");
    const shown = left >= 0 && left <= this.#plot.over.clientWidth + 0.5;
    this.#playhead.style.transform = `translateX(${shown ? left.toFixed(1) : -10}px)`;
  }

  #legend(): HTMLElement {
    const count = this.#spec.traces.reduce((sum, { lines }) => sum + lines.length, 0);
    const list = el("ul", { class: count > 2 ? "legend legend-many" : "legend" });
    for (const trace of this.#spec.traces) {
      trace.lines.forEach((line, curve) => {
        const cell = new TextCell("–");
        this.#values.push({ cell, trace, curve });
        const sample = el("span", { class: line.dash === undefined ? "line-sample" : "line-sample line-dashed" });
        sample.style.color = line.colour(this.#group.palette());
        this.#samples.push({ sample, line });
        list.append(el("li", {}, sample, `${line.label} `, el("span", { class: "value" }, cell.node)));
      });
    }
    return list;
  }

  /** Takes the theme's colours. */
  recolour(): void {
    for (const { sample, line } of this.#samples) sample.style.color = line.colour(this.#group.palette());
    if (this.#plot !== null) this.draw();
  }

  /** In words, for those who cannot see it. */
  #describe(): void {
    const all = this.#spec.traces.flatMap((trace) => trace.curves);
    let [low, high] = [Number.POSITIVE_INFINITY, Number.NEGATIVE_INFINITY];
    for (const values of all) {
      for (const value of values) {
        if (value < low) low = value;
        if (value > high) high = value;
      }
    }
    const { title, unit, scale, decimals, levels } = this.#spec;
    const span = low <= high ? `from ${fixed(low * scale, decimals)} to ${fixed(high * scale, decimals)} ${unit}` : "without values";
    const limits = levels.map((level) => `, ${level.label} ${fixed(level.value, decimals)} ${unit}`).join("");
    this.#box.setAttribute("aria-label", `${title} over time, ${span}${limits}`);
    const [floor, ceiling] = this.#spec.cut ?? [Number.NEGATIVE_INFINITY, Number.POSITIVE_INFINITY];
    const [least, most] = [low * scale, high * scale];
    this.#peak.set(least < floor || most > ceiling ? `, cut: ${span}` : "");
  }

  #yRange(low: number | null, high: number | null): [number, number] {
    const [least, most] = this.#spec.range;
    const [floor, ceiling] = this.#spec.cut ?? [Number.NEGATIVE_INFINITY, Number.POSITIVE_INFINITY];
    const [from, to] = [Math.max(floor, Math.min(least, low ?? least)), Math.min(ceiling, Math.max(most, high ?? most))];
    const air = 0.04 * (to - from);
    return [from === 0 ? 0 : from - air, to + air];
  }

  #options(width: number): uPlot.Options {
    const palette = this.#group.palette();
    const axis = {
      stroke: palette.muted,
      grid: { stroke: palette.line, width: 1 },
      ticks: { show: false },
      font: "11px system-ui, sans-serif",
    };
    const lines = this.#spec.traces.flatMap((trace) => trace.lines);
    return {
      width,
      height: HEIGHT_PX,
      padding: [6, 8, 0, 0],
      legend: { show: false },
      scales: { x: { time: false, range: () => [this.#xRange().min, this.#xRange().max] }, y: { range: (_, low, high) => this.#yRange(low, high) } },
      axes: [
        { ...axis, size: 22, gap: 2, space: 46 },
        { ...axis, size: 44, gap: 4, space: 24 },
      ],
      series: [
        {},
        ...lines.map((line) => ({ stroke: line.colour(palette), width: 1.25, points: { show: false }, spanGaps: true, ...(line.dash === undefined ? {} : { dash: line.dash }) })),
      ],
      cursor: {
        y: false,
        points: { show: false },
        sync: { key: SYNC },
        drag: { x: true, y: false, setScale: false },
        bind: {
          dblclick: () => () => {
            this.#group.zoom(null);
            return null;
          },
        },
      },
      hooks: {
        drawClear: [(plot) => this.#drawGround(plot)],
        draw: [(plot) => this.#drawLevels(plot)],
        setSelect: [(plot) => this.#select(plot)],
      },
    };
  }

  #select(plot: uPlot): void {
    const { left, width } = plot.select;
    plot.setSelect({ left: 0, top: 0, width: 0, height: 0 }, false);
    if (width < 6) return;
    this.#group.zoom([plot.posToVal(left, "x"), plot.posToVal(left + width, "x")]);
  }

  /** Stretches of washing. */
  #drawGround(plot: uPlot): void {
    const { ctx, bbox } = plot;
    ctx.save();
    ctx.globalAlpha = 0.07;
    ctx.fillStyle = this.#group.palette().segments.wash;
    for (const segment of this.#group.segments) {
      if (segment.kind !== "wash") continue;
      const from = Math.max(bbox.left, plot.valToPos(segment.t_start_s, "x", true));
      const to = Math.min(bbox.left + bbox.width, plot.valToPos(segment.t_end_s, "x", true));
      if (to > from) ctx.fillRect(from, bbox.top, to - from, bbox.height);
    }
    ctx.restore();
  }

  #drawLevels(plot: uPlot): void {
    const { ctx, bbox } = plot;
    const palette = this.#group.palette();
    ctx.save();
    ctx.fillStyle = palette.limit;
    ctx.strokeStyle = palette.limit;
    ctx.lineWidth = Math.max(1, devicePixelRatio);
    ctx.setLineDash([4 * devicePixelRatio, 3 * devicePixelRatio]);
    for (const level of this.#spec.levels) {
      const y = plot.valToPos(level.value, "y", true);
      const [top, bottom] = [bbox.top, bbox.top + bbox.height];
      if (!(y >= top && y <= bottom)) continue;
      ctx.beginPath();
      ctx.moveTo(bbox.left, y);
      ctx.lineTo(bbox.left + bbox.width, y);
      ctx.stroke();
      ctx.globalAlpha = 0.1;
      if (level.bad === "above") ctx.fillRect(bbox.left, top, bbox.width, y - top);
      else ctx.fillRect(bbox.left, y, bbox.width, bottom - y);
      ctx.globalAlpha = 1;
    }
    ctx.restore();
  }
}

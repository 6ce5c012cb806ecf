/** Play, pause, speed and time, over the film's length: segments in their colours, worst places above, a head that can be dragged. */
import { SPEEDS, stepSpeed } from "../clock.ts";
import { clockTime, plateNumber, segmentAt, segmentWords, spokenTime } from "../format.ts";
import type { Palette } from "../palette.ts";
import { RANK, statusWord } from "../verdict.ts";
import type { Check, PlanSegment, Status, View } from "../view.ts";
import { button, byId, el, icon, TextCell, toneIcon } from "./dom.ts";

export interface Cluster {
  /** [s] */
  time: number;
  /** The worst of its statuses. */
  status: Status;
  /** The worst first. */
  checks: Check[];
}

/** Width of a mark [px]. */
export const MARK_PX = 20;

export function clusters(checks: readonly Check[], duration: number, width: number): Cluster[] {
  const timed = checks
    .map((check) => ({ check, time: check.worst.time_s }))
    .filter((entry): entry is { check: Check; time: number } => entry.time !== undefined && entry.time >= 0 && entry.time <= duration)
    .sort((a, b) => a.time - b.time);
  const apart = width > 0 ? (MARK_PX * duration) / width : Number.POSITIVE_INFINITY;
  const groups = timed.map(({ check, time }): Cluster => ({ time, status: check.status, checks: [check] }));
  for (let k = 1; k < groups.length; ) {
    if (groups[k]!.time - groups[k - 1]!.time >= apart) {
      k++;
      continue;
    }
    // The merged mark stands at its worst place, perhaps nearer to the one before.
    groups.splice(k - 1, 2, merged(groups[k - 1]!, groups[k]!));
    k = Math.max(1, k - 1);
  }
  return groups;
}

function merged(a: Cluster, b: Cluster): Cluster {
  const [worse, other] = RANK[b.status] < RANK[a.status] ? [b, a] : [a, b];
  const checks = [...worse.checks, ...other.checks].sort((one, two) => RANK[one.status] - RANK[two.status]);
  return { time: worse.time, status: worse.status, checks };
}

export interface ScrubberActions {
  seek(t: number): void;
  /** A mark of worst places was chosen. */
  choose(check: Check): void;
}

/** Width that a plate's number needs in its segment [px]. */
const NUMBER_PX = 15;
/** Least time between two changes of what screen readers hear [ms]. */
const SPOKEN_MS = 700;

export class Scrubber {
  readonly element: HTMLElement;
  #view: View;
  #duration: number;
  readonly #actions: ScrubberActions;
  readonly #canvas = el("canvas", { set: { "aria-hidden": "true" } });
  /** Above the shade, so that plates' numbers stay legible. */
  readonly #numbers = el("canvas", { set: { "aria-hidden": "true" } });
  readonly #future = el("div", { class: "scrubber-future" });
  readonly #unknown = el("div", { class: "scrubber-unknown" });
  readonly #head = el("div", { class: "scrubber-head" });
  readonly #hint = el("div", { class: "scrubber-hint", set: { "aria-hidden": "true" } });
  readonly #marks = el("div", { class: "scrubber-marks", set: { role: "group", "aria-label": "Worst places of the requirements" } });
  readonly #track: HTMLElement;
  #width = 0;
  #time = 0;
  #edge: number;
  #spoken = -SPOKEN_MS;
  #palette: Palette;

  constructor(view: View, duration: number, palette: Palette, actions: ScrubberActions) {
    this.#view = view;
    this.#duration = duration;
    this.#edge = duration;
    this.#palette = palette;
    this.#actions = actions;
    const slider = {
      role: "slider",
      tabindex: 0,
      "aria-label": "Time",
      "aria-valuemin": 0,
      "aria-valuemax": duration.toFixed(2),
      "aria-valuenow": 0,
    };
    this.#track = el("div", { class: "scrubber-track", set: slider }, this.#canvas, this.#future, this.#unknown, this.#numbers, this.#head);
    this.#hint.hidden = true;
    this.element = el("div", { class: "scrubber" }, this.#marks, this.#track, this.#hint);
    this.#listen();
    new ResizeObserver(() => this.#resized()).observe(this.#track);
  }

  /** Shows the length of another document. */
  replace(view: View, duration: number): void {
    const marks = view.certificate !== this.#view.certificate || duration !== this.#duration;
    this.#view = view;
    this.#duration = duration;
    this.#edge = duration;
    this.#spoken = -SPOKEN_MS;
    this.#track.setAttribute("aria-valuemax", duration.toFixed(2));
    this.#draw();
    this.#place();
    if (marks) this.#drawMarks();
  }

  /** Shows a time; up to `edge` there is something to show. No layout: head and shade are moved alone. */
  update(t: number, edge: number, now: number): void {
    if (t !== this.#time || edge !== this.#edge) {
      this.#time = t;
      this.#edge = edge;
      this.#place();
    }
    if (now - this.#spoken < SPOKEN_MS && now >= this.#spoken) return;
    const value = t.toFixed(2);
    if (this.#track.getAttribute("aria-valuenow") === value) return;
    this.#spoken = now;
    this.#track.setAttribute("aria-valuenow", value);
    this.#track.setAttribute("aria-valuetext", `${spokenTime(t)}, ${this.#wordsAt(t)}`);
  }

  setPalette(palette: Palette): void {
    this.#palette = palette;
    this.#draw();
  }

  #share(t: number): number {
    return this.#duration > 0 ? Math.max(0, Math.min(1, t / this.#duration)) : 0;
  }

  #wordsAt(t: number): string {
    const segment = this.#view.segments[segmentAt(this.#view.segments, t, 0)];
    return segment === undefined ? "" : segmentWords(segment, this.#view);
  }

  #place(): void {
    const [at, edge] = [this.#share(this.#time), this.#share(this.#edge)];
    this.#head.style.transform = `translateX(${(at * this.#width).toFixed(2)}px)`;
    this.#future.style.transform = `translateX(${(at * this.#width).toFixed(2)}px) scaleX(${Math.max(0, edge - at).toFixed(5)})`;
    this.#unknown.style.transform = `translateX(${(edge * this.#width).toFixed(2)}px) scaleX(${(1 - edge).toFixed(5)})`;
  }

  #resized(): void {
    this.#width = this.#track.clientWidth;
    this.#draw();
    this.#place();
    this.#drawMarks();
  }

  #draw(): void {
    const height = this.#track.clientHeight;
    const [bars, numbers] = [this.#blank(this.#canvas, height), this.#blank(this.#numbers, height)];
    if (bars === null || numbers === null) return;
    numbers.font = "700 11px system-ui, sans-serif";
    numbers.textAlign = "center";
    numbers.textBaseline = "middle";
    numbers.lineJoin = "round";
    numbers.lineWidth = 2.5;
    numbers.strokeStyle = "rgb(0 0 0 / 60%)";
    numbers.fillStyle = "#fff";
    for (const segment of this.#view.segments) this.#drawSegment(bars, numbers, segment, height);
  }

  /** A canvas of the track's size, in CSS pixels, with nothing on it. */
  #blank(canvas: HTMLCanvasElement, height: number): CanvasRenderingContext2D | null {
    const scale = Math.min(3, devicePixelRatio);
    canvas.width = Math.max(1, Math.round(this.#width * scale));
    canvas.height = Math.max(1, Math.round(height * scale));
    const context = canvas.getContext("2d");
    context?.scale(scale, scale);
    return context;
  }

  #drawSegment(bars: CanvasRenderingContext2D, numbers: CanvasRenderingContext2D, segment: PlanSegment, height: number): void {
    const from = this.#share(segment.t_start_s) * this.#width;
    const to = this.#share(segment.t_end_s) * this.#width;
    const inset = segment.kind === "wash" ? 0 : 0.28 * height;
    bars.fillStyle = this.#palette.segments[segment.kind];
    bars.fillRect(from, inset, Math.max(0.5, to - from - (segment.kind === "wash" ? 1 : 0)), height - 2 * inset);
    if (segment.kind !== "wash" || to - from < NUMBER_PX) return;
    const number = plateNumber(this.#view.plates, segment.plate);
    numbers.strokeText(number, (from + to) / 2, height / 2 + 0.5);
    numbers.fillText(number, (from + to) / 2, height / 2 + 0.5);
  }

  #drawMarks(): void {
    const checks = this.#view.certificate?.checks ?? [];
    const groups = clusters(checks, this.#duration, this.#width);
    this.element.classList.toggle("unmarked", groups.length === 0);
    this.#marks.replaceChildren(...groups.map((group) => this.#mark(group)));
  }

  #mark(group: Cluster): HTMLElement {
    const lines = group.checks.map(({ words, status, worst }) => `${words}: ${statusWord(status).toLowerCase()}, worst at ${spokenTime(worst.time_s ?? group.time)}`);
    const label = lines.join("; ");
    let next = 0;
    const choose = (): void => {
      this.#actions.choose(group.checks[next % group.checks.length]!);
      next++;
    };
    const mark = button({ class: `mark tone-${group.status}`, label }, choose, toneIcon(group.status));
    if (group.checks.length > 1) mark.dataset["count"] = String(group.checks.length);
    const half = MARK_PX / 2;
    mark.style.left = `${Math.max(half, Math.min(this.#width - half, this.#share(group.time) * this.#width)).toFixed(1)}px`;
    return mark;
  }

  #listen(): void {
    const timeAt = (event: PointerEvent): number => {
      const box = this.#track.getBoundingClientRect();
      return box.width > 0 ? ((event.clientX - box.left) / box.width) * this.#duration : 0;
    };
    this.#track.addEventListener("pointerdown", (event) => {
      if (event.button !== 0) return;
      this.#track.setPointerCapture(event.pointerId);
      this.#actions.seek(timeAt(event));
    });
    this.#track.addEventListener("pointermove", (event) => {
      if (this.#track.hasPointerCapture(event.pointerId)) this.#actions.seek(timeAt(event));
      this.#showHint(Math.max(0, Math.min(this.#duration, timeAt(event))));
    });
    for (const type of ["pointerleave", "pointercancel"]) {
      this.#track.addEventListener(type, () => {
        this.#hint.hidden = true;
      });
    }
  }

  #showHint(t: number): void {
    this.#hint.hidden = false;
    this.#hint.textContent = `${clockTime(t, this.#duration)} s  ${this.#wordsAt(t)}`;
    const room = Math.max(0, this.#width - this.#hint.offsetWidth);
    const left = this.#share(t) * this.#width - this.#hint.offsetWidth / 2;
    this.#hint.style.transform = `translateX(${Math.max(0, Math.min(room, left)).toFixed(1)}px)`;
  }
}

export interface TransportActions extends ScrubberActions {
  toggle(): void;
  toStart(): void;
  /** To the segment before or behind. */
  segment(direction: 1 | -1): void;
  speed(speed: number): void;
}

const MULTIPLY = "\u202f×";

export class Transport {
  readonly #play: HTMLButtonElement;
  readonly #time = new TextCell();
  readonly #speed: HTMLSelectElement;
  readonly #other = el("option", { set: { hidden: "" } });
  readonly #scrubber: Scrubber;
  readonly #end = new TextCell();
  #duration = 0;
  #held = false;
  #playing: boolean | null = null;

  constructor(view: View, duration: number, palette: Palette, actions: TransportActions) {
    this.#play = button({ class: "button play-button" }, () => actions.toggle());
    const options = SPEEDS.map((speed) => el("option", { set: { value: speed } }, `${speed}${MULTIPLY}`));
    this.#speed = el("select", { class: "speed", set: { "aria-label": "Speed" } }, ...options, this.#other);
    this.#speed.addEventListener("change", () => actions.speed(Number(this.#speed.value)));
    this.#scrubber = new Scrubber(view, duration, palette, actions);
    const root = byId("transport");
    root.replaceChildren(
      this.#scrubber.element,
      el(
        "div",
        { class: "controls" },
        button({ class: "button icon-button", label: "To the start (Home)" }, () => actions.toStart(), icon("first")),
        button({ class: "button icon-button", label: "Segment before" }, () => actions.segment(-1), icon("previous")),
        this.#play,
        button({ class: "button icon-button", label: "Next segment" }, () => actions.segment(1), icon("next")),
        el("span", { class: "time" }, el("span", { class: "time-now" }, this.#time.node), " / ", this.#end.node),
        el(
          "span",
          { class: "speeds" },
          button({ class: "button bare-button", label: "Slower ([)" }, () => actions.speed(stepSpeed(Number(this.#speed.value), false)), "−"),
          this.#speed,
          button({ class: "button bare-button", label: "Faster (])" }, () => actions.speed(stepSpeed(Number(this.#speed.value), true)), "+"),
        ),
      ),
    );
    this.setSpeed(1);
    this.setPlaying(false);
    this.#setDuration(duration);
  }

  /** Shows the time of another document. */
  replace(view: View, duration: number): void {
    this.#setDuration(duration);
    this.#scrubber.replace(view, duration);
  }

  #setDuration(duration: number): void {
    this.#duration = duration;
    this.#end.set(`${clockTime(duration, duration)} s`);
    byId("transport").classList.toggle("no-film", duration === 0);
    this.hold(this.#held);
  }

  /** Whether the film must stand still. */
  hold(on: boolean): void {
    this.#held = on;
    this.#play.disabled = on || this.#duration === 0;
  }

  update(t: number, edge: number, now: number): void {
    this.#time.set(clockTime(t, this.#duration));
    this.#scrubber.update(t, edge, now);
  }

  setPlaying(playing: boolean): void {
    if (playing === this.#playing) return;
    this.#playing = playing;
    const label = playing ? "Pause (Space)" : "Play (Space)";
    this.#play.replaceChildren(icon(playing ? "pause" : "play"));
    this.#play.setAttribute("aria-label", label);
    this.#play.title = label;
  }

  setSpeed(speed: number): void {
    const listed = SPEEDS.some((one) => one === speed);
    this.#other.value = String(speed);
    this.#other.textContent = `${Number(speed.toFixed(2))}${MULTIPLY}`;
    this.#other.hidden = listed;
    this.#speed.value = String(speed);
  }

  setPalette(palette: Palette): void {
    this.#scrubber.setPalette(palette);
  }
}

/** State of the arm at this moment in figures, over the scene; and its joint angles in words. */
import { Matrix4 } from "three";
import { positionShare, stepLength } from "../curves.ts";
import { cleanShare } from "../dirt.ts";
import { degrees, fixed, millimetres, percent, percentDown, quantity, segmentWords } from "../format.ts";
import { AXES, Kinematics } from "../motion.ts";
import type { Player } from "../player.ts";
import type { View } from "../view.ts";
import { el, isolated, TextCell } from "./dom.ts";

/** Half the step of the difference that gives the tip's speed [s], and the least. */
const [DIFFERENCE_S, LEAST_DIFFERENCE_S] = [2e-3, 1e-6] as const;
/** Least time between two changes: faster than this nobody reads [ms]. */
const READABLE_MS = 90;

interface Figure {
  element: HTMLElement;
  name: TextCell;
  value: TextCell;
  note: TextCell;
}

function figure(words: string): Figure {
  const [name, value, note] = [new TextCell(words), new TextCell(), new TextCell()];
  const element = el(
    "div",
    { class: "figure" },
    el("dt", {}, name.node),
    el("dd", {}, el("span", { class: "figure-value" }, value.node), el("span", { class: "figure-note" }, note.node)),
  );
  return { element, name, value, note };
}

export class Readout {
  readonly element: HTMLElement;
  readonly #player: Player;
  #kinematics: Kinematics;
  readonly #activity = new TextCell();
  readonly #speed = figure("tip speed");
  readonly #clearance = figure("clearance");
  readonly #coverage = figure("swept");
  readonly #clean = figure("clean, proved");
  readonly #error = figure("off the plan");
  readonly #swatch = el("span", { class: "swatch" });
  #shareAt: (plate: number, t: number) => number | null;
  /** Joints a moment before and after. */
  readonly #rows = new Float64Array(2 * AXES);
  #updated = Number.NEGATIVE_INFINITY;

  constructor(player: Player, shareAt: (plate: number, t: number) => number | null) {
    this.#player = player;
    this.#shareAt = shareAt;
    this.#kinematics = new Kinematics(player.view.arm, player.view.tool);
    this.element = el(
      "div",
      { class: "readout" },
      el("p", { class: "activity" }, this.#swatch, el("bdi", {}, this.#activity.node)),
      el("dl", { class: "figures" }, this.#speed.element, this.#coverage.element, this.#clean.element, this.#error.element, this.#clearance.element),
    );
  }

  /** The player shows another document. */
  replace(shareAt: (plate: number, t: number) => number | null): void {
    this.#shareAt = shareAt;
    this.#kinematics = new Kinematics(this.#player.view.arm, this.#player.view.tool);
    // Its place stays free, so that the scene does not move when a film comes or goes.
    this.element.classList.toggle("empty", this.#player.duration === 0);
  }

  /** Shows the moment; `anew` whatever time it is. */
  update(now: number, anew: boolean): void {
    if (!anew && now >= this.#updated && now - this.#updated < READABLE_MS) return;
    this.#updated = now;
    this.#showActivity();
    this.#speed.value.set(quantity(this.#tipSpeed(), 3, "m/s"));
    this.#showClearance();
    this.#showCoverage();
    this.#showError();
  }

  #showActivity(): void {
    const { segment, view } = this.#player;
    this.#activity.set(segment === null ? "At rest" : segmentWords(segment, view));
    this.#swatch.style.background = segment === null ? "" : `var(--segment-${segment.kind})`;
  }

  #tipSpeed(): number {
    const { time, edge } = this.#player;
    // As far to either side, so that an arm that rests at an end is seen to.
    const half = Math.max(LEAST_DIFFERENCE_S, Math.min(DIFFERENCE_S, time, edge - time));
    const from = Math.max(0, time - half);
    const to = Math.min(edge, time + half);
    if (to <= from) return 0;
    [from, to].forEach((t, end) => this.#player.jointsAt(t, this.#rows.subarray(end * AXES, (end + 1) * AXES)));
    return stepLength(this.#kinematics.places(this.#rows), 1) / (to - from);
  }

  #showClearance(): void {
    const { clearances, time } = this.#player;
    const now = clearances?.at(time) ?? null;
    this.#clearance.element.hidden = now === null;
    if (now === null || clearances === null) return;
    const under = now.distance_m < now.margin_m;
    this.#clearance.element.classList.toggle("bad", under);
    this.#clearance.value.set(millimetres(now.distance_m));
    this.#clearance.note.set(`${under ? "under" : "margin"} ${fixed(1000 * now.margin_m, 0)}, ${clearances.pairAt(time)}`);
  }

  #showCoverage(): void {
    const { segment, time, view } = this.#player;
    const plate = segment?.plate ?? null;
    const counted = view.coverage.find((coverage) => plate === null || coverage.plate === plate)?.counted ?? null;
    this.#coverage.name.set(counted?.is_promised ? "pressed" : counted === null ? "swept" : "touched");
    const share = plate === null || segment?.kind === "transit" ? null : this.#shareAt(plate, time);
    this.#coverage.element.classList.toggle("faint", share === null);
    this.#coverage.value.set(share === null ? "–" : percentDown(share));
    const clean = share === null ? null : cleanShare(view, plate!, time);
    this.#clean.element.hidden = view.dirt.length === 0;
    this.#clean.element.classList.toggle("faint", clean === null);
    this.#clean.value.set(clean === null ? "–" : percentDown(clean));
  }

  #showError(): void {
    const { recording, time, follows } = this.#player;
    const k = follows === "executed" && recording !== null ? recording.sampleAt(time) : -1;
    this.#error.element.hidden = k < 0;
    if (k >= 0) this.#error.value.set(millimetres(recording?.errorOf(k) ?? Number.NaN, 2));
  }
}

function jointRow(view: View, j: number): HTMLElement {
  const joint = view.arm.joints[j]!;
  const q = view.pose_rad[j] ?? Number.NaN;
  const share = positionShare(joint, q);
  const beyond = !(Math.abs(share) <= 1);
  const needle = el("span", { class: "range-needle" });
  needle.style.left = `${(50 + 50 * Math.max(-1, Math.min(1, share))).toFixed(2)}%`;
  return el(
    "tr",
    { class: beyond ? "bad" : "" },
    el("th", { set: { scope: "row" } }, isolated(joint.name)),
    el("td", {}, fixed(degrees(q), 3)),
    el("td", {}, fixed(q, 6)),
    el("td", { class: "range-cell" }, el("span", { class: "range", set: { "aria-hidden": "true" } }, needle), beyond ? "beyond its limit" : percent(share)),
  );
}

/** Joints, tip and clearance of the configuration. */
export function configuration(view: View): HTMLElement {
  const head = el("tr", {}, ...["joint", "deg", "rad", "of its range"].map((words) => el("th", { set: { scope: "col" } }, words)));
  const table = el(
    "table",
    { class: "joints" },
    el("thead", {}, head),
    el("tbody", {}, ...view.arm.joints.map((_, j) => jointRow(view, j))),
  );
  const tip = new Kinematics(view.arm, view.tool).tip(view.pose_rad, new Matrix4());
  const place = tip.elements.slice(12, 15).map((value) => fixed(value, 4)).join(", ");
  const list = el("dl", { class: "origin" }, el("dt", {}, view.tool === null ? "flange" : "tip"), el("dd", {}, `(${place}) m`));
  const clearance = view.clearance;
  if (clearance !== null) list.append(el("dt", {}, "margin"), el("dd", {}, millimetres(clearance.margin_m)));
  return el("div", {}, table, list);
}

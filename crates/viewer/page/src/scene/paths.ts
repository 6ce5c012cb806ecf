/** Ways of the tip: what it follows on plates, how it travels between them, and where it really went. */
import { GreaterDepth, Group } from "three";
import { AXES, Kinematics, Motion, newState } from "../motion.ts";
import { floats, indexBefore } from "../numbers.ts";
import type { PlanSegment, View } from "../view.ts";
import { Lines, simplified, stretches } from "./lines.ts";
import type { Palette } from "./palette.ts";

/** Stretches a second of motion. */
const RATE_HZ = 60;
/** Stretches of all transits together, at most. */
const MOST = 30_000;
/** Lines are drawn this near to the ways that they show [m]. */
const TOLERANCE_M = 0.00015;
/** Widths [m], which count where the picture is so small that those in pixels would fill it. */
const WIDEST_M = 0.009;
/** Wash paths are drawn so far above the plate [m]. */
const LIFT_M = 0.0006;

/** The planned way of the tip through one segment. */
function travelled(segment: PlanSegment, motion: Motion, kinematics: Kinematics, rate_hz: number): Float64Array {
  const span = segment.t_end_s - segment.t_start_s;
  const count = Math.max(2, Math.min(MOST, Math.ceil(span * rate_hz) + 1));
  const state = newState();
  const rows = new Float64Array(AXES * count);
  for (let i = 0; i < count; i++) rows.set(motion.at(segment.t_start_s + (span * i) / (count - 1), state).q, AXES * i);
  return kinematics.places(rows);
}

/** The planned ways of the tip where it does not wash. */
function transits(view: View, kinematics: Kinematics): Float64Array[] {
  if (view.motion === null) return [];
  const motion = Motion.of(view.motion);
  const segments = view.segments.filter(({ kind, t_start_s, t_end_s }) => kind !== "wash" && t_end_s > t_start_s);
  const total = segments.reduce((sum, { t_start_s, t_end_s }) => sum + t_end_s - t_start_s, 0);
  const rate = Math.min(RATE_HZ, MOST / Math.max(1, total));
  return segments.map((segment) => travelled(segment, motion, kinematics, rate));
}

/** How faint lines are that belong to a plan of other places. */
const FAINT = 0.22;

/** Wash paths, lifted along the normals of their plates: the plate, and stretches of line. */
function washed(view: View): { plate: number; ends: Float32Array }[] {
  return view.paths.map((path) => {
    const points = floats(path.points_m).slice();
    const [w, x, y, z] = view.plates[path.plate]?.pose.quaternion_wxyz ?? [1, 0, 0, 0];
    const normal = [2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)];
    for (let i = 0; i < points.length; i++) points[i]! += LIFT_M * normal[i % 3]!;
    return { plate: path.plate, ends: stretches([simplified(points, TOLERANCE_M)]) };
  });
}

/** All stretches one after the other. */
function joined(parts: readonly { ends: Float32Array }[]): Float32Array {
  const all = new Float32Array(parts.reduce((sum, { ends }) => sum + ends.length, 0));
  let at = 0;
  for (const { ends } of parts) {
    all.set(ends, at);
    at += ends.length;
  }
  return all;
}

/** The executed way, which may grow. */
class Executed {
  readonly root = new Group();
  #times: number[] = [];
  #places: number[] = [];
  #lines: Lines[] = [];
  #shown = 0;
  #colour = "#000000";

  constructor(times: ArrayLike<number>, places: ArrayLike<number>) {
    this.append(times, places);
  }

  setColour(colour: string): void {
    this.#colour = colour;
    for (const lines of this.#lines) lines.setColour(colour);
  }

  /** Adds samples; those that are new begin another set of lines, and sets are joined as they get many. */
  append(times: ArrayLike<number>, places: ArrayLike<number>): void {
    if (times.length === 0) return;
    const from = Math.max(0, this.#times.length - 1);
    for (let i = 0; i < times.length; i++) this.#times.push(times[i]!);
    for (let i = 0; i < places.length; i++) this.#places.push(places[i]!);
    const many = this.#lines.length >= 32;
    if (many) this.#clear();
    this.#draw(many ? 0 : from);
  }

  #clear(): void {
    for (const lines of this.#lines) {
      lines.removeFromParent();
      lines.geometry.dispose();
      lines.style.dispose();
    }
    this.#lines = [];
  }

  #draw(from: number): void {
    const ends = stretches([this.#places.slice(3 * from)]);
    if (ends.length === 0) return;
    const lines = new Lines(ends, { width: 1.5, before: 2 });
    lines.userData["from"] = from;
    lines.setColour(this.#colour);
    lines.renderOrder = 3;
    this.#lines.push(lines);
    this.root.add(lines);
  }

  /** Shows what was done by `t` [s]. No allocation. */
  show(t: number): void {
    this.#shown = indexBefore(this.#times, this.#times.length, t, this.#shown);
    for (const lines of this.#lines) {
      const count = this.#shown - (lines.userData["from"] as number);
      lines.visible = count > 0;
      lines.setCount(count);
    }
  }
}

/** The lines of all ways of the tip. */
export class Paths {
  readonly wash = new Group();
  readonly transits: Lines;
  readonly executed: Group;
  readonly #near: Lines;
  readonly #hidden: Lines;
  /** Wash paths of plates that have been moved since. */
  readonly #old: Lines;
  readonly #washed: { plate: number; ends: Float32Array }[];
  #moved = "";
  readonly #executed: Executed;
  readonly #kinematics: Kinematics;

  constructor(view: View) {
    this.#kinematics = new Kinematics(view.arm, view.tool);
    this.#washed = washed(view);
    const ends = joined(this.#washed);
    this.#near = new Lines(ends, { width: 2.6, before: 3 });
    this.#near.renderOrder = 2;
    this.#hidden = new Lines(ends, { width: 1.6, opacity: 0.22, depth: GreaterDepth });
    this.#hidden.renderOrder = 1;
    this.#old = new Lines(new Float32Array(0), { width: 1.6, opacity: FAINT });
    this.#old.renderOrder = 2;
    this.wash.add(this.#near, this.#hidden, this.#old);
    this.transits = new Lines(stretches(transits(view, this.#kinematics).map((line) => simplified(line, TOLERANCE_M))), { width: 1.7 });
    const execution = view.execution;
    const rows = execution === null ? new Float64Array(0) : floats(execution.q_rad);
    this.#executed = new Executed(execution === null ? [] : floats(execution.t_s), this.#kinematics.places(rows));
    this.executed = this.#executed.root;
  }

  setPalette(palette: Palette): void {
    this.#near.setColour(palette.wash);
    this.#hidden.setColour(palette.wash);
    this.#old.setColour(palette.wash);
    this.transits.setColour(palette.transit);
    this.#executed.setColour(palette.executed);
  }

  /** Adds executed samples: their times [s], and six joint positions each [rad]. */
  append(times: ArrayLike<number>, rows: ArrayLike<number>): void {
    this.#executed.append(times, this.#kinematics.places(rows));
  }

  /** Keeps lines apart in small pictures, of so many pixels a metre. No allocation. */
  setScale(pixels_m: number): void {
    const share = Math.max(0.3, Math.min(1, (WIDEST_M * pixels_m) / 2.6));
    this.#near.setWidth(2.6 * share);
    this.#hidden.setWidth(1.6 * share);
    this.transits.setWidth(1.7 * share);
  }

  /** Whether what something hides of the wash paths is seen through it. */
  setSeenThrough(on: boolean): void {
    this.#hidden.visible = on && this.#hidden.any;
  }

  show(t: number): void {
    this.#executed.show(t);
  }

  /** Draws faintly what belongs to a plan in which these plates lay elsewhere: their wash paths, and all transits. */
  fade(moved: ReadonlySet<number>): void {
    const key = [...moved].join(" ");
    if (key === this.#moved) return;
    this.#moved = key;
    const ends = joined(this.#washed.filter(({ plate }) => !moved.has(plate)));
    this.#near.setEnds(ends);
    this.#hidden.setEnds(ends);
    this.#old.setEnds(joined(this.#washed.filter(({ plate }) => moved.has(plate))));
    this.transits.setFaint(moved.size > 0 ? FAINT : 1);
  }
}

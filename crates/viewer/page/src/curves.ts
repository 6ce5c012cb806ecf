/** Curves over time: what the plots draw, sampled to look at, and the smallest clearance as the document has it. */
import { AXES, type JointState, Kinematics, type Motion, newState } from "./motion.ts";
import { decode, floats, indexBefore } from "./numbers.ts";
import type { Arm, Clearance, Joint, Tool } from "./view.ts";

/** Points of a curve at most: beyond that, knots are left out for equal steps. */
const MOST_POINTS = 8000;
/** Half the step of the difference that gives the tip's speed [s]. */
const DIFFERENCE_S = 5e-4;

/** Times that ascend and a value of each curve at each. */
export interface Curves {
  times: Float64Array;
  curves: Float64Array[];
}

/** Six joints over time as shares of their limits. */
export interface JointShares {
  position: Curves;
  speed: Curves;
  /** Null where no limit is stated. */
  acceleration: Curves | null;
}

/** The knots' times, and the middles between them where there is room; else equal steps. */
export function sampleTimes(motion: Motion, most = MOST_POINTS): Float64Array {
  const knots = motion.times;
  const n = knots.length;
  if (2 * n - 1 <= most) return Float64Array.from({ length: 2 * n - 1 }, (_, k) => 0.5 * (knots[k >> 1]! + knots[(k + 1) >> 1]!));
  if (n <= most) return knots;
  return Float64Array.from({ length: most }, (_, k) => (motion.duration * k) / (most - 1));
}

/** −1 at the lower limit, 1 at the upper one, 0 in the middle, and wherever there is no limit. */
export function positionShare(joint: Joint, q: number): number {
  if (joint.position_rad === null) return 0;
  const [low, high] = joint.position_rad;
  return (2 * q - low - high) / (high - low);
}

/** A curve for each joint: its `value` in the state that `place` finds for each time. */
function perJoint(
  times: Float64Array,
  place: (t: number, k: number, into: JointState) => void,
  value: (state: JointState, j: number) => number,
): Curves {
  const curves = Array.from({ length: AXES }, () => new Float64Array(times.length));
  const state = newState();
  times.forEach((t, k) => {
    place(t, k, state);
    curves.forEach((curve, j) => (curve[k] = value(state, j)));
  });
  return { times, curves };
}

export function jointShares(motion: Motion, joints: readonly Joint[]): JointShares {
  const times = sampleTimes(motion);
  const place = (t: number, _: number, into: JointState): JointState => motion.at(t, into);
  return {
    position: perJoint(times, place, ({ q }, j) => positionShare(joints[j]!, q[j]!)),
    speed: perJoint(times, place, ({ qd }, j) => qd[j]! / joints[j]!.speed_rad_s),
    acceleration: joints.every((joint) => joint.acceleration_rad_s2 === null) ? null : accelerations(motion, joints),
  };
}

/** Accelerations jump at knots: both sides of each are in the curves. */
function accelerations(motion: Motion, joints: readonly Joint[]): Curves {
  const stride = Math.max(1, Math.ceil((2 * motion.times.length) / MOST_POINTS));
  const knot = (k: number): number => stride * (k >> 1);
  const times = Float64Array.from({ length: 2 * Math.ceil(motion.times.length / stride) }, (_, k) => motion.times[knot(k)]!);
  const place = (t: number, k: number, into: JointState): JointState => (k % 2 === 0 ? motion.before(knot(k), into) : motion.at(t, into));
  return perJoint(times, place, ({ qdd }, j) => qdd[j]! / (joints[j]!.acceleration_rad_s2 ?? Number.NaN));
}

/** The tip's speed over time [m/s], by differences of its places. */
export function tipSpeed(motion: Motion, arm: Arm, tool: Tool | null): Curves {
  const times = sampleTimes(motion, MOST_POINTS / 2);
  const state = newState();
  const rows = new Float64Array(2 * AXES * times.length);
  const span = (t: number): [number, number] => [Math.max(0, t - DIFFERENCE_S), Math.min(motion.duration, t + DIFFERENCE_S)];
  times.forEach((t, k) => span(t).forEach((at, end) => rows.set(motion.at(at, state).q, (2 * k + end) * AXES)));
  const places = new Kinematics(arm, tool).places(rows);
  const speeds = times.map((t, k) => {
    const [from, to] = span(t);
    return to > from ? stepLength(places, 2 * k + 1) / (to - from) : 0;
  });
  return { times, curves: [speeds] };
}

/** The tip's speed of what was recorded [m/s], by differences from sample to sample. */
export function recordedTipSpeed(times: Float64Array, positions: Float64Array, arm: Arm, tool: Tool | null): Curves {
  const places = new Kinematics(arm, tool).places(positions);
  const speeds = times.map((t, k) => (k === 0 ? 0 : stepLength(places, k) / (t - times[k - 1]!)));
  if (times.length > 1) speeds[0] = speeds[1]!;
  return { times, curves: [speeds] };
}

/** From a place to the one before it, three numbers each. */
export function stepLength(places: Float64Array, k: number): number {
  const [x, y, z] = [0, 1, 2].map((i) => places[3 * k + i]! - places[3 * k - 3 + i]!);
  return Math.hypot(x!, y!, z!);
}

/** Rows of six as six curves, each divided by its own limit. */
export function shares(times: Float64Array, rows: Float64Array, limits: readonly number[]): Curves {
  return { times, curves: limits.map((limit, j) => times.map((_, k) => rows[k * AXES + j]! / limit)) };
}

/** The value of a curve at `t`, linear between its points; NaN outside. */
export function valueAt({ times, curves }: Curves, curve: number, t: number): number {
  if (times.length === 0 || t < times[0]! - 1e-9 || t > times[times.length - 1]! + 1e-9) return Number.NaN;
  const k = indexBefore(times, times.length, t, 0);
  const next = Math.min(k + 1, times.length - 1);
  const [from, to, value] = [times[k]!, times[next]!, curves[curve]![k]!];
  const share = to > from ? Math.max(0, Math.min(1, (t - from) / (to - from))) : 0;
  return value + (curves[curve]![next]! - value) * share;
}

export type Point = [number, number, number];

/** The smallest clearance at one time. */
export interface ClearanceNow {
  distance_m: number;
  margin_m: number;
  /** The nearest points of the two bodies, world frame. */
  from: Point;
  to: Point;
}

export class Clearances {
  readonly margin: number;
  readonly times: Float64Array;
  readonly distances: Float64Array;
  readonly #points: Float64Array;
  readonly #pair: ArrayLike<number>;
  readonly #names: readonly string[];
  readonly #now: ClearanceNow;
  #hint = 0;

  constructor(clearance: Clearance) {
    this.margin = clearance.margin_m;
    this.times = floats(clearance.t_s);
    this.distances = floats(clearance.distance_m);
    this.#points = floats(clearance.nearest_m);
    this.#pair = decode(clearance.pair);
    this.#names = clearance.names;
    this.#now = { distance_m: Number.NaN, margin_m: this.margin, from: [0, 0, 0], to: [0, 0, 0] };
  }

  /** The sample nearest to `t`; null without any. The object is used again by the next call. */
  at(t: number): ClearanceNow | null {
    if (this.times.length === 0) return null;
    const k = this.#nearest(t);
    const now = this.#now;
    now.distance_m = this.distances[k]!;
    for (let i = 0; i < 3; i++) {
      now.from[i] = this.#points[6 * k + i]!;
      now.to[i] = this.#points[6 * k + 3 + i]!;
    }
    return now;
  }

  /** The two bodies of the sample nearest to `t`. */
  pairAt(t: number): string {
    if (this.times.length === 0) return "";
    const k = this.#nearest(t);
    const name = (side: 0 | 1): string => this.#names[this.#pair[2 * k + side] ?? -1] ?? "?";
    return `${name(0)} – ${name(1)}`;
  }

  #nearest(t: number): number {
    const count = this.times.length;
    const k = indexBefore(this.times, count, t, this.#hint);
    this.#hint = k;
    return k + 1 < count && this.times[k + 1]! - t < t - this.times[k]! ? k + 1 : k;
  }
}

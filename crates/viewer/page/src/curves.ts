/** What the plots draw: curves over time, sampled to look at. */
import { Kinematics } from "./kinematics.ts";
import { AXES, newState, type Motion } from "./motion.ts";
import type { Arm, Joint, Tool } from "./view.ts";

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
  if (2 * n - 1 <= most) {
    return Float64Array.from({ length: 2 * n - 1 }, (_, k) =>
      k % 2 === 0 ? knots[k / 2]! : 0.5 * (knots[(k - 1) / 2]! + knots[(k + 1) / 2]!),
    );
  }
  if (n <= most) return knots;
  return Float64Array.from({ length: most }, (_, k) => (motion.duration * k) / (most - 1));
}

/** −1 at the lower limit, 1 at the upper one, 0 in the middle, and wherever there is no limit. */
export function positionShare(joint: Joint, q: number): number {
  if (joint.position_rad === null) return 0;
  const [low, high] = joint.position_rad;
  return (2 * q - low - high) / (high - low);
}

function sixOf(count: number): Float64Array[] {
  return Array.from({ length: AXES }, () => new Float64Array(count));
}

export function jointShares(motion: Motion, joints: readonly Joint[]): JointShares {
  const times = sampleTimes(motion);
  const [position, speed] = [sixOf(times.length), sixOf(times.length)];
  const state = newState();
  times.forEach((t, k) => {
    motion.at(t, state);
    joints.forEach((joint, j) => {
      position[j]![k] = positionShare(joint, state.q[j]!);
      speed[j]![k] = state.qd[j]! / joint.speed_rad_s;
    });
  });
  return { position: { times, curves: position }, speed: { times, curves: speed }, acceleration: accelerations(motion, joints) };
}

/** Accelerations jump at knots: both sides of each are in the curves. */
function accelerations(motion: Motion, joints: readonly Joint[]): Curves | null {
  if (joints.every((joint) => joint.acceleration_rad_s2 === null)) return null;
  const all = motion.times.length;
  const stride = Math.max(1, Math.ceil((2 * all) / MOST_POINTS));
  const knots = Array.from({ length: Math.ceil(all / stride) }, (_, k) => k * stride);
  const times = new Float64Array(2 * knots.length);
  const curves = sixOf(times.length);
  const state = newState();
  const put = (at: number): void =>
    joints.forEach((joint, j) => {
      curves[j]![at] = joint.acceleration_rad_s2 === null ? Number.NaN : state.qdd[j]! / joint.acceleration_rad_s2;
    });
  knots.forEach((knot, k) => {
    const t = motion.times[knot]!;
    times[2 * k] = t;
    times[2 * k + 1] = t;
    motion.before(knot, state);
    put(2 * k);
    motion.at(t, state);
    put(2 * k + 1);
  });
  return { times, curves };
}

/** The tip's speed over time [m/s], by differences of its places. */
export function tipSpeed(motion: Motion, arm: Arm, tool: Tool | null): Curves {
  const times = sampleTimes(motion, MOST_POINTS / 2);
  const kinematics = new Kinematics(arm, tool);
  const [before, after] = [new Float64Array(16), new Float64Array(16)];
  const state = newState();
  const placeAt = (t: number, into: Float64Array): void => {
    kinematics.tip(motion.at(t, state).q, into);
  };
  const speeds = times.map((t) => {
    const from = Math.max(0, t - DIFFERENCE_S);
    const to = Math.min(motion.duration, t + DIFFERENCE_S);
    placeAt(from, before);
    placeAt(to, after);
    return to > from ? distance(before, after) / (to - from) : 0;
  });
  return { times, curves: [speeds] };
}

/** The tip's speed of what was recorded [m/s], by differences from sample to sample. */
export function recordedTipSpeed(times: Float64Array, positions: Float64Array, arm: Arm, tool: Tool | null): Curves {
  const kinematics = new Kinematics(arm, tool);
  const speeds = new Float64Array(times.length);
  let [last, here] = [new Float64Array(16), new Float64Array(16)];
  for (let k = 0; k < times.length; k++) {
    kinematics.tip(positions, here, k * AXES);
    if (k > 0) speeds[k] = distance(last, here) / (times[k]! - times[k - 1]!);
    [last, here] = [here, last];
  }
  if (times.length > 1) speeds[0] = speeds[1]!;
  return { times, curves: [speeds] };
}

/** Between the places of two poses. */
function distance(a: Float64Array, b: Float64Array): number {
  return Math.hypot(b[12]! - a[12]!, b[13]! - a[13]!, b[14]! - a[14]!);
}

/** Rows of six as six curves, each divided by its own limit. */
export function shares(times: Float64Array, rows: Float64Array, limits: readonly number[]): Curves {
  const curves = sixOf(times.length);
  for (let k = 0; k < times.length; k++) {
    for (let j = 0; j < AXES; j++) curves[j]![k] = rows[k * AXES + j]! / limits[j]!;
  }
  return { times, curves };
}

/** The value of a curve at `t`, linear between its points; NaN outside. `k` is the index before `t`. */
export function valueAt(curves: Curves, curve: number, t: number, k: number): number {
  const { times } = curves;
  const values = curves.curves[curve]!;
  const [from, to] = [times[k]!, times[k + 1] ?? times[k]!];
  if (times.length === 0 || t < times[0]! - 1e-9 || t > times[times.length - 1]! + 1e-9) return Number.NaN;
  const share = to > from ? Math.max(0, Math.min(1, (t - from) / (to - from))) : 0;
  return values[k]! + ((values[k + 1] ?? values[k]!) - values[k]!) * share;
}

/** Plates in the hand: where their centres get to as the pointer goes from one place to another. */

/** A plate's centre seen from above [m]. */
export type Centre = [number, number];

/** What the pointer does to the plates that it holds. */
export interface Grab {
  plates: number[];
  /** Their centres before. */
  starts_m: Centre[];
  /** Where the pointer took hold. */
  from_m: Centre;
  /** Null: they are shifted. Else they are turned about this place, the base axis. */
  about_m: Centre | null;
  /** In place of plates a body that stands around. */
  body?: number;
}

/** Steps of centres and of turns, and those of a hand that wants it finer. */
const STEP_M = 0.001;
const FINE_M = 0.0001;
const STEP_RAD = Math.PI / 360;
const FINE_RAD = Math.PI / 3600;
/** Plates are not carried farther than this from the world's origin [m]. */
const FARTHEST_M = 10;

/** `value` on a raster of so many steps a unit: a quotient, so that tenths of millimetres are the decimal numbers that they look like. */
export function stepped(value: number, per_unit: number): number {
  return Math.round(value * per_unit) / per_unit + 0;
}

/** The middle of centres; the origin of none. */
export function middle(centres: readonly Centre[]): Centre {
  const count = Math.max(1, centres.length);
  const sum = centres.reduce<Centre>((at, [x, y]) => [at[0] + x, at[1] + y], [0, 0]);
  return [sum[0] / count, sum[1] / count];
}

/** One plate's centre comes to lie on the raster; several keep how they lie to each other, so that their way does. */
function shifted({ starts_m, from_m }: Grab, to: Centre, fine: boolean): Centre[] {
  const per_m = Math.round(1 / (fine ? FINE_M : STEP_M));
  const way: Centre = [to[0] - from_m[0], to[1] - from_m[1]];
  if (starts_m.length === 1) return starts_m.map(([x, y]) => [stepped(x + way[0], per_m), stepped(y + way[1], per_m)]);
  const [dx, dy] = [stepped(way[0], per_m), stepped(way[1], per_m)];
  return starts_m.map(([x, y]) => [stepped(x + dx, 1e9), stepped(y + dy, 1e9)]);
}

/** By how much the pointer has turned about a place, on the raster [rad]. */
export function turnOf(about: Centre, from: Centre, to: Centre, fine: boolean): number {
  const angle = Math.atan2(to[1] - about[1], to[0] - about[0]) - Math.atan2(from[1] - about[1], from[0] - about[0]);
  const step = fine ? FINE_RAD : STEP_RAD;
  return Math.round(Math.atan2(Math.sin(angle), Math.cos(angle)) / step) * step;
}

function turned({ starts_m, from_m }: Grab, about: Centre, to: Centre, fine: boolean): Centre[] {
  const angle = turnOf(about, from_m, to, fine);
  return starts_m.map((centre) => (angle === 0 ? [...centre] : turnedAbout(centre, about, angle)));
}

/** A centre turned about an upright axis, counter-clockwise seen from above, to a tenth of a millimetre. */
export function turnedAbout([x, y]: Centre, axis: Centre, angle_rad: number): Centre {
  const [c, s, dx, dy] = [Math.cos(angle_rad), Math.sin(angle_rad), x - axis[0], y - axis[1]];
  const per_m = Math.round(1 / FINE_M);
  return [stepped(axis[0] + c * dx - s * dy, per_m), stepped(axis[1] + s * dx + c * dy, per_m)];
}

/** Where the plates' centres get to with the pointer at `to`; null where that is nowhere. */
export function carried(grab: Grab, to: Centre, fine: boolean): Centre[] | null {
  const centres = grab.about_m === null ? shifted(grab, to, fine) : turned(grab, grab.about_m, to, fine);
  return centres.every((centre) => centre.every((x) => Math.abs(x) <= FARTHEST_M)) ? centres : null;
}

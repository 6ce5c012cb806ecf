/** Where plates go when they are shifted, turned, added. */
import type { Selection } from "../scene/editing.ts";
import { stepped, turnedAbout, type Centre } from "../scene/grab.ts";

/** Digits that are kept of a place [m]: a micrometre. */
const PLACE = 1e6;

export function plateIndices(selected: Selection, count: number): number[] {
  if (selected === "all") return Array.from({ length: count }, (_, k) => k);
  return selected !== null && selected < count ? [selected] : [];
}

function moved(centres: readonly Centre[], plates: readonly number[], to: (centre: Centre) => Centre): Centre[] {
  return centres.map((centre, k) => (plates.includes(k) ? to(centre) : centre));
}

export function shifted(centres: readonly Centre[], plates: readonly number[], dx: number, dy: number): Centre[] {
  // A coordinate that does not change keeps all its digits.
  const by = (value: number, step: number): number => (step === 0 ? value : stepped(value + step, PLACE));
  return moved(centres, plates, ([x, y]) => [by(x, dx), by(y, dy)]);
}

/** The world's axis along which something points, seen from above. */
function along([dx, dy]: Centre): Centre {
  return Math.abs(dx) >= Math.abs(dy) ? [Math.sign(dx), 0] : [0, Math.sign(dy)];
}

/** A shift on the screen, to the right and upwards, as one along the world's axes that are nearest to that. `ahead` is where upwards points. */
export function onFloor(right_m: number, up_m: number, ahead: Centre): Centre {
  const [ux, uy] = along(ahead);
  return [ux * up_m + uy * right_m, uy * up_m - ux * right_m];
}

/** Turned about an upright axis, counter-clockwise seen from above. */
export function turned(centres: readonly Centre[], plates: readonly number[], axis: Centre, angle_rad: number): Centre[] {
  return moved(centres, plates, (centre) => turnedAbout(centre, axis, angle_rad));
}

/** A place for one more plate: the nearest to the axis that touches no plate; beside the farthest where there is none. */
export function roomFor(centres: readonly Centre[], radius_m: number, axis: Centre, keepOff_m: number): Centre {
  const apart = 2 * radius_m + 0.02;
  for (let ring = Math.max(keepOff_m + 0.02, apart); ring < keepOff_m + 20 * apart; ring += radius_m / 2) {
    for (let k = 0; k < 24; k++) {
      // From the front alternately to either side.
      const angle = (k % 2 === 0 ? -1 : 1) * Math.ceil(k / 2) * (Math.PI / 12);
      const [x, y] = [stepped(axis[0] + ring * Math.cos(angle), 1e3), stepped(axis[1] + ring * Math.sin(angle), 1e3)];
      if (centres.every((one) => Math.hypot(one[0] - x, one[1] - y) > apart)) return [x, y];
    }
  }
  return [stepped(axis[0] + keepOff_m + 20 * apart, 1e3), axis[1]];
}

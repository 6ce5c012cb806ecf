/** Where plates go when they are shifted, turned, added, and places of plates and bodies as changes of the scenario. */
import type { Selection } from "../scene/editing.ts";
import { stepped, turnedAbout, type Centre } from "../scene/handles.ts";
import type { Edit } from "./history.ts";
import type { BodyMove, PlateMoves } from "./protocol.ts";

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

/** A place for one more plate: the nearest to the axis that touches no plate, in so many of 24 ways about the front; beside the farthest where there is none. */
export function roomFor(centres: readonly Centre[], radius_m: number, axis: Centre, keepOff_m: number, front_rad = 0, ways = 24): Centre {
  const apart = 2 * radius_m + 0.02;
  for (let ring = Math.max(keepOff_m + 0.02, apart); ring < keepOff_m + 20 * apart; ring += radius_m / 2) {
    for (let k = 0; k < ways; k++) {
      // From the front alternately to either side.
      const angle = front_rad + (k % 2 === 0 ? -1 : 1) * Math.ceil(k / 2) * (Math.PI / 12);
      const [x, y] = [stepped(axis[0] + ring * Math.cos(angle), 1e3), stepped(axis[1] + ring * Math.sin(angle), 1e3)];
      if (centres.every((one) => Math.hypot(one[0] - x, one[1] - y) > apart)) return [x, y];
    }
  }
  return [stepped(axis[0] + keepOff_m + 20 * apart, 1e3), axis[1]];
}

export const POSITIONS = "layout.positions_m";

/** Digits of a coordinate that follows another [1/m]. */
const DIGITS = 1e9;

const follow = (value: number, from: number, to: number): number => (from === to ? value : stepped(value + to - from, DIGITS));

const follow2 = (at: Centre, from: Centre, to: Centre): Centre => [follow(at[0], from[0], to[0]), follow(at[1], from[1], to[1])];

/** Why plates are not moved there; null where they are. So many plates as before are moved, where each has a section of its own. */
export function unmoved(moves: PlateMoves | undefined, count: number): string | null {
  if (moves?.by === "nothing") return moves.words;
  if (moves?.by === "sections" && moves.sections.length !== count) return "Each of these plates is a [[plate]] section: add or remove one in the text.";
  return null;
}

/** The faces of one plate move together: where one was moved, the other follows. */
export function together(moves: PlateMoves | undefined, were: readonly Centre[], centres: readonly Centre[]): Centre[] {
  const to = centres.map(([x, y]): Centre => [x, y]);
  if (moves?.by !== "sections") return to;
  const stays = (plate: number): boolean => String(were[plate]) === String(centres[plate]);
  moves.sections.forEach((section, plate) => {
    const other = moves.sections.findIndex((one, k) => one === section && k !== plate);
    if (other < 0 || stays(plate) || !stays(other)) return;
    const [from, at] = [were[plate]!, centres[plate]!];
    to[other] = follow2(to[other]!, from, at);
  });
  return to;
}

/** The changes that put plates there. Their heights stay. */
export function placing(moves: PlateMoves | undefined, centres: readonly Centre[]): Edit[] {
  if (moves?.by !== "sections") return [{ key: POSITIONS, value: centres.map(([x, y]): Centre => [x, y]) }];
  return moves.at_m.flatMap((at, section) => {
    // Of a plate with two faces the first is where the section says.
    const centre = centres[moves.sections.indexOf(section)];
    return centre === undefined ? [] : [{ key: `plate[${section}].at_m`, value: [...centre, at[2]] }];
  });
}

/**
 * The changes that take along what holds plates: a body all of whose plates go the same way. `were` is where plates are drawn, and `at` where a
 * body is; `start` is where plates were before anything moved, which is elsewhere once an answer on the way has been drawn.
 */
export function carrying(
  bodies: readonly BodyMove[],
  were: readonly Centre[],
  to: readonly Centre[],
  at: (body: number) => Centre | null,
  start: readonly Centre[] = were,
): Edit[] {
  // Plates that were added or removed are numbered anew.
  if (were.length !== to.length || start.length !== to.length) return [];
  const way = (plate: number): Centre => follow2([0, 0], were[plate]!, to[plate]!);
  return bodies.flatMap((move, body) => {
    const held = (move.holds ?? [...to.keys()]).filter((plate) => plate < to.length);
    const from = at(body);
    const [first] = held;
    if (first === undefined || from === null || String(start[first]) === String(to[first])) return [];
    if (held.some((plate) => String(way(plate)) !== String(way(first)))) return [];
    return putting(move, follow2(from, were[first]!, to[first]!));
  });
}

/** A body that stands around, put somewhere. */
export interface Put {
  body: number;
  centre_m: Centre;
}

/** The change that puts a body there; none for one that is not moved. */
export function putting(move: BodyMove | undefined, [x, y]: Centre): Edit[] {
  return move === undefined || move.key === null ? [] : [{ key: move.key, value: [x, y, ...move.at_m.slice(2)] }];
}

/** Places of plates and of what stands around, as changes of the scenario. */
import { stepped, type Centre } from "../scene/grab.ts";
import type { BodyMove, PlateMoves } from "./protocol.ts";
import type { Edit } from "./version.ts";

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

/** The changes that take along what holds plates: a body all of whose plates go the same way. `at` is where a body is now. */
export function carrying(bodies: readonly BodyMove[], were: readonly Centre[], to: readonly Centre[], at: (body: number) => Centre | null): Edit[] {
  // Plates that were added or removed are numbered anew.
  if (were.length !== to.length) return [];
  const way = (plate: number): Centre => follow2([0, 0], were[plate]!, to[plate]!);
  return bodies.flatMap((move, body) => {
    const held = (move.holds ?? [...to.keys()]).filter((plate) => plate < to.length);
    const from = at(body);
    const [first] = held;
    if (first === undefined || from === null || String(way(first)) === "0,0") return [];
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

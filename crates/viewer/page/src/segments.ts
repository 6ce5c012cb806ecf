/** The parts of a motion in words and in order. */
import type { Plate, Segment, SegmentKind, View } from "./view.ts";

const NAMES: Record<SegmentKind, string> = {
  depart: "Leaving home",
  approach: "Approaching",
  wash: "Washing",
  retreat: "Retreating from",
  transit: "On the way to",
  return: "Returning home",
};

/** In a dry run nothing is where the sponge moves. */
const IN_AIR: Record<SegmentKind, string> = { ...NAMES, wash: "In the air over" };

/** A plate's number in its name, as files count it; its place in the list where its name has none. */
export function plateNumber(plates: readonly Plate[], index: number): string {
  return /(\d{1,4})$/.exec(plates[index]?.name ?? "")?.[1] ?? String(index);
}

/** What the arm does in a segment. */
export function segmentWords(segment: Segment, { heading, plates }: Pick<View, "heading" | "plates">): string {
  const names = heading.dry_run === null ? NAMES : IN_AIR;
  const plate = plates[segment.plate];
  if (segment.kind === "depart" || segment.kind === "return") return names[segment.kind];
  if (plate === undefined) return segment.kind === "transit" ? "On the way" : names[segment.kind].replace(/ (from|over)$/, "");
  return `${names[segment.kind]} ${plate.name}`;
}

/** The segment at `t`, searched from `hint` on; -1 where there is none. Segments are in order of time. */
export function segmentAt(segments: readonly Segment[], t: number, hint: number): number {
  const fits = (k: number): boolean => {
    const segment = segments[k];
    return segment !== undefined && segment.t_start_s <= t && t < segment.t_end_s;
  };
  if (fits(hint)) return hint;
  if (fits(hint + 1)) return hint + 1;
  const found = segments.findLastIndex((segment) => segment.t_start_s <= t);
  const last = segments[found];
  return last !== undefined && t <= last.t_end_s ? found : -1;
}

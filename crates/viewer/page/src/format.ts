/** Numbers and the parts of a motion in words, for people. */
import type { PlanSegment, Plate, SegmentKind, View } from "./view.ts";

const MINUS = "\u2212";
const NARROW_SPACE = "\u202f";

/** A number with a fixed count of decimals and a real minus sign; an en dash where there is none. */
export function fixed(value: number, decimals: number): string {
  if (!Number.isFinite(value)) return "–";
  const text = Math.abs(value).toFixed(decimals);
  return value < 0 && Number(text) !== 0 ? MINUS + text : text;
}

/** A number with at most so many decimals, without zeros at its end. */
export function fixedShort(value: number, decimals: number): string {
  return fixed(value, decimals).replace(/(\.\d*?)0+$/u, "$1").replace(/\.$/u, "");
}

/** A number with its unit. */
export function quantity(value: number, decimals: number, unit: string): string {
  return `${fixed(value, decimals)}${NARROW_SPACE}${unit}`;
}

/** A share as a percentage. */
export function percent(share: number, decimals = 0): string {
  return quantity(100 * share, decimals, "%");
}

/** A share that must not look larger than it is: rounded down to one decimal; 100 where nothing but rounding is missing. */
export function percentDown(share: number): string {
  return share >= 1 - 1e-9 ? quantity(100, 0, "%") : quantity(Math.floor(1000 * share + 1e-9) / 10, 1, "%");
}

/** A length [m] in millimetres. */
export function millimetres(metres: number, decimals = 1): string {
  return quantity(1000 * metres, decimals, "mm");
}

/** A time of the film [s]: seconds to a hundredth, with minutes where the film has them. */
export function clockTime(t: number, end: number): string {
  if (end < 100) return fixed(t, 2);
  const minutes = Math.floor(t / 60);
  return `${minutes}:${(t - 60 * minutes).toFixed(1).padStart(4, "0")}`;
}

/** A time in words, for screen readers and tooltips. */
export function spokenTime(t: number): string {
  return `${fixed(t, 2)} seconds`;
}

export function degrees(radians: number): number {
  return (radians * 180) / Math.PI;
}

/** A count and its noun. */
export function counted(count: number, noun: string): string {
  return `${count}${NARROW_SPACE}${count === 1 ? noun : `${noun}s`}`;
}

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

/** A plate's name; its number where it has none. */
export function plateName(plates: readonly Plate[] | undefined, index: number): string {
  return plates?.[index]?.name ?? `plate ${index + 1}`;
}

/** A plate's number in its name; its place in the list, from 1, where its name has none. */
export function plateNumber(plates: readonly Plate[], index: number): string {
  return /(\d{1,4})$/.exec(plateName(plates, index))?.[1] ?? String(index + 1);
}

/** What the arm does in a segment. */
export function segmentWords(segment: PlanSegment, { heading, plates }: Pick<View, "heading" | "plates">): string {
  const names = heading.dry_run === null ? NAMES : IN_AIR;
  const plate = plates[segment.plate];
  if (segment.kind === "depart" || segment.kind === "return") return names[segment.kind];
  if (plate === undefined) return segment.kind === "transit" ? "On the way" : names[segment.kind].replace(/ (from|over)$/, "");
  return `${names[segment.kind]} ${plate.name}`;
}

/** The segment at `t`, searched from `hint` on; -1 where there is none. Segments are in order of time. */
export function segmentAt(segments: readonly PlanSegment[], t: number, hint: number): number {
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

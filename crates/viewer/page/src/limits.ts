/** Requirements in groups, each with its share of the limit. */
import { fixedShort } from "./format.ts";
import { RANK } from "./verdict.ts";
import type { Check, Measure } from "./view.ts";

export type GroupName = "Washed" | "Safe" | "Within limits";

/** Requirements by group, those that people look at first in front. What is not listed is within limits, before the joints. */
const GROUPS: Readonly<Record<GroupName, readonly string[]>> = {
  Washed: ["pressed", "swept", "contact_time", "contact_dose", "contact_force", "plate_stays", "contact_height", "path_deviation", "wash_paths", "every_plate_once"],
  Safe: ["clearance", "reduced_clearance", "contact_speed", "strain", "tilt", "reach", "line_deviation", "wrist", "rest_at_wash_ends", "plates_apart", "plates", "exclusions", "tool", "arm", "dry_run"],
  "Within limits": ["wash_speed", "wash_acceleration", "tip_speed", "tip_acceleration", "plan_deviation", "segments", "home_to_home"],
};

const JOINTS = /^joint_/;

function groupOf({ requirement }: Check): GroupName {
  const found = (Object.keys(GROUPS) as GroupName[]).find((name) => GROUPS[name].includes(requirement));
  return found ?? "Within limits";
}

/** Place within the group: what is not kept first, the joints last. */
function order(name: GroupName, { requirement, status }: Check): [number, number] {
  const place = GROUPS[name].indexOf(requirement);
  return [RANK[status], JOINTS.test(requirement) ? 1000 : place < 0 ? 999 : place];
}

export interface Group {
  name: GroupName;
  checks: Check[];
}

/** The groups that have requirements; those with what is not kept first. */
export function grouped(checks: readonly Check[]): Group[] {
  const groups = (Object.keys(GROUPS) as GroupName[]).map((name): Group => {
    const own = checks.filter((check) => groupOf(check) === name);
    own.sort((a, b) => {
      const [[rank, place], [other, at]] = [order(name, a), order(name, b)];
      return rank - other || place - at;
    });
    return { name, checks: own };
  });
  return groups.filter((group) => group.checks.length > 0).sort((a, b) => RANK[a.checks[0]!.status] - RANK[b.checks[0]!.status]);
}

/** How much of its limit a bound takes: 1 at the limit, above it beyond; null where that says nothing. Of a share, how much of what may be missing is. */
export function shareOf({ bound, limit, sense, unit }: Measure): number | null {
  if (bound === null || !Number.isFinite(bound)) return null;
  if (sense === "at_most") return limit > 0 ? Math.max(0, bound / limit) : null;
  if (unit === "1") return limit < 1 ? Math.max(0, (1 - bound) / (1 - limit)) : null;
  return limit > 0 && bound > 0 ? limit / bound : null;
}

/** Factor and sign of a unit for people. */
const UNITS: Readonly<Record<string, [number, string]>> = { "1": [100, "%"], m: [1000, "mm"], rad: [180 / Math.PI, "°"], "rad/s^2": [1, "rad/s²"], "m/s^2": [1, "m/s²"], "N m": [1, "N·m"] };
const SIGNS = { at_most: "≤", at_least: "≥", above: ">" } as const;

/** Two decimals, or two digits of what is smaller than 1, rounded towards the limit. */
function rounded(value: number, upwards: boolean): string {
  const decimals = value === 0 || Math.abs(value) >= 1 ? 2 : Math.min(9, 1 - Math.floor(Math.log10(Math.abs(value))));
  const scale = 10 ** decimals;
  return fixedShort((upwards ? Math.ceil(value * scale - 1e-6) : Math.floor(value * scale + 1e-6)) / scale, decimals);
}

/** Bound and limit: “0.95 ≤ 1 m/s”. */
export function measureWords({ bound, limit, sense, unit }: Measure): string {
  const [factor, sign] = UNITS[unit] ?? [1, unit];
  const shown = bound === null ? "no bound" : rounded(factor * bound, sense === "at_most");
  return `${shown} ${SIGNS[sense]} ${fixedShort(factor * limit, 4)}\u202f${sign}`;
}

/** Requirements in groups, each with its share of the limit. */
import { fixedShort } from "./format.ts";
import { RANK } from "./verdict.ts";
import type { Check, Measure, RequirementGroup } from "./view.ts";

export interface Group {
  name: RequirementGroup;
  checks: Check[];
}

/** The groups that have requirements; those with what is not kept first, and in each what is not kept first. The program says which requirement is in which group, and where. */
export function grouped(checks: readonly Check[]): Group[] {
  const found: Record<RequirementGroup, Check[]> = { Washed: [], Safe: [], "Within limits": [] };
  for (const check of checks) found[check.why.group].push(check);
  const groups = (Object.keys(found) as RequirementGroup[]).map((name): Group => {
    return { name, checks: found[name].sort((a, b) => RANK[a.status] - RANK[b.status] || a.why.place - b.why.place) };
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

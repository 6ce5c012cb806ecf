/** Worst places along the film: those that would cover each other become one mark. */
import type { Check, Status } from "../view.ts";

export interface Cluster {
  /** [s] */
  time: number;
  /** The worst of its statuses. */
  status: Status;
  /** The worst first. */
  checks: Check[];
}

/** Width of a mark [px]. */
export const MARK_PX = 20;

const RANK: Record<Status, number> = { violated: 0, not_proved: 1, waived: 2, proved: 3 };

export function clusters(checks: readonly Check[], duration: number, width: number): Cluster[] {
  const timed = checks
    .map((check) => ({ check, time: check.worst?.time_s ?? null }))
    .filter((entry): entry is { check: Check; time: number } => entry.time !== null && entry.time >= 0 && entry.time <= duration)
    .sort((a, b) => a.time - b.time);
  const apart = width > 0 ? (MARK_PX * duration) / width : Number.POSITIVE_INFINITY;
  const groups = timed.map(({ check, time }): Cluster => ({ time, status: check.status, checks: [check] }));
  for (let k = 1; k < groups.length; ) {
    if (groups[k]!.time - groups[k - 1]!.time >= apart) {
      k++;
      continue;
    }
    // The merged mark stands at its worst place, perhaps nearer to the one before.
    groups.splice(k - 1, 2, merged(groups[k - 1]!, groups[k]!));
    k = Math.max(1, k - 1);
  }
  return groups;
}

function merged(a: Cluster, b: Cluster): Cluster {
  const [worse, other] = RANK[b.status] < RANK[a.status] ? [b, a] : [a, b];
  const checks = [...worse.checks, ...other.checks].sort((one, two) => RANK[one.status] - RANK[two.status]);
  return { time: worse.time, status: worse.status, checks };
}

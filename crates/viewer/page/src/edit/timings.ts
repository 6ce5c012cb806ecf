/** When questions were asked, answered and drawn: for tests and measurements. */
import type { Milliseconds } from "./protocol.ts";

/** Times are `performance.now()` [ms]; null for what has not come. */
export interface Timing {
  want: "preview" | "proof";
  asked: number;
  scenario: number | null;
  preview: number | null;
  plan: number | null;
  proof: number | null;
  drawnPlan: number | null;
  drawnProof: number | null;
  /** What steps took where they were done. */
  ms: Milliseconds;
}

/** Questions that are remembered. */
const KEPT = 200;

export class Timings {
  readonly #list: Timing[] = [];

  begin(want: Timing["want"], now: number): Timing {
    const timing: Timing = { want, asked: now, scenario: null, preview: null, plan: null, proof: null, drawnPlan: null, drawnProof: null, ms: {} };
    this.#list.push(timing);
    if (this.#list.length > KEPT) this.#list.shift();
    return timing;
  }

  list(): Timing[] {
    return structuredClone(this.#list);
  }
}

/** Notes that a line came. */
export function arrived(timing: Timing, kind: string, ms: Milliseconds | undefined, now: number): void {
  if (kind === "scenario" || kind === "preview" || kind === "plan" || kind === "proof") timing[kind] ??= now;
  if (ms !== undefined) Object.assign(timing.ms, ms);
}

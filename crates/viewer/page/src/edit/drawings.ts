/** Notes when plans and proofs are drawn, and who waits for that. */
import type { Cell } from "./cell.ts";

export class Drawings {
  readonly #cell: Cell;
  #waiting: (() => void)[] = [];

  constructor(cell: Cell) {
    this.#cell = cell;
  }

  /** A frame was drawn at `now` [ms]; `all`: nothing has changed since. */
  drawn(now: number, all: boolean): void {
    const timing = this.#cell.planned?.timing ?? null;
    if (timing !== null && all) {
      if (timing.plan !== null) timing.drawnPlan ??= now;
      if (timing.proof !== null) timing.drawnProof ??= now;
    }
    if (!all || !this.#cell.settled || this.#waiting.length === 0) return;
    const waiting = this.#waiting;
    this.#waiting = [];
    for (const done of waiting) done();
  }

  settled(): Promise<void> {
    return new Promise((resolve) => this.#waiting.push(resolve));
  }
}

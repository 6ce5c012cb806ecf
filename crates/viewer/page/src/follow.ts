/** Shows a live run a moment behind its newest sample, so that the arm moves evenly however samples arrive. */

/** How far behind the newest sample [s]. */
export const BEHIND_S = 0.15;
/** A gap that is jumped instead of caught up with [s]. */
const JUMP_S = 1.5;
/** Catching up changes the speed by at most this share. */
const HASTE = 0.5;

export class Follower {
  #time = 0;
  #now: number | null = null;

  get time(): number {
    return this.#time;
  }

  /** The time to show at `now` [ms], with the newest sample at `end` [s]. It never goes backwards nor beyond that sample. */
  tick(now: number, end: number): number {
    const passed = this.#now === null ? 0 : Math.max(0, now - this.#now) / 1000;
    this.#now = now;
    const behind = Math.max(0, end - BEHIND_S) - this.#time;
    if (behind > JUMP_S) this.#time += behind;
    else this.#time += passed * (1 + Math.max(-HASTE, Math.min(HASTE, 2 * (behind - passed))));
    this.#time = Math.min(this.#time, end);
    return this.#time;
  }

  /** Goes on from `time`. */
  from(time: number): void {
    this.#time = time;
    this.#now = null;
  }
}

/** Time of the film: plays, pauses, jumps, and follows a live run. It reads no clock of its own. */

export const SLOWEST = 0.1;
export const FASTEST = 10;

/** Speeds that keys and buttons step through. */
export const SPEEDS = [0.1, 0.25, 0.5, 1, 2, 5, 10] as const;

/** A film's time [s], driven by a clock [ms] that is handed in. */
export class Clock {
  #time = 0;
  #end: number;
  #speed = 1;
  #playing = false;
  /** Where and when the last jump, start or change of speed was: time is computed from there, so that no error adds up. */
  #anchorTime = 0;
  #anchorNow = 0;

  constructor(end: number) {
    this.#end = Math.max(0, end);
  }

  get time(): number {
    return this.#time;
  }

  get end(): number {
    return this.#end;
  }

  /** Another film: goes on at `t` [s], or as far as the film goes. */
  setEnd(end: number, t: number, now: number): void {
    this.#end = Math.max(0, end);
    this.seek(t, now);
    if (this.#time >= this.#end) this.#playing = false;
  }

  get speed(): number {
    return this.#speed;
  }

  get playing(): boolean {
    return this.#playing;
  }

  /** Goes to where `now` [ms] has it; whether time changed. A clock that runs backwards holds it. */
  tick(now: number): boolean {
    if (!this.#playing) return false;
    const passed = Math.max(0, now - this.#anchorNow) / 1000;
    const before = this.#time;
    this.#time = Math.max(before, this.#within(this.#anchorTime + passed * this.#speed));
    if (this.#time >= this.#end) this.#playing = false;
    return this.#time !== before;
  }

  /** Starts; from the beginning where it had ended. */
  play(now: number): void {
    if (this.#playing || this.#end <= 0) return;
    if (this.#time >= this.#end) this.#time = 0;
    this.#playing = true;
    this.#anchor(now);
  }

  pause(now: number): void {
    this.tick(now);
    this.#playing = false;
  }

  /** Jumps to `t` [s], within the film; what is no number is ignored. */
  seek(t: number, now: number): void {
    if (Number.isNaN(t)) return;
    this.#time = this.#within(t);
    this.#anchor(now);
  }

  /** Changes the speed, within 0.1 and 10; what is no number is ignored. */
  setSpeed(speed: number, now: number): void {
    if (Number.isNaN(speed)) return;
    this.tick(now);
    this.#speed = Math.max(SLOWEST, Math.min(FASTEST, speed));
    this.#anchor(now);
  }

  /** Goes on from where it is, as if no time had passed since the last tick: after a pause that was not asked for. */
  resume(now: number): void {
    this.#anchor(now);
  }

  #anchor(now: number): void {
    this.#anchorTime = this.#time;
    this.#anchorNow = now;
  }

  #within(t: number): number {
    return Math.max(0, Math.min(this.#end, t));
  }
}

/** The next speed up or down from `speed`. */
export function stepSpeed(speed: number, up: boolean): number {
  if (up) return SPEEDS.find((s) => s > speed * 1.001) ?? FASTEST;
  return SPEEDS.findLast((s) => s < speed * 0.999) ?? SLOWEST;
}

/** How far behind the newest sample [s]. */
export const BEHIND_S = 0.15;
/** A gap that is jumped instead of caught up with [s]. */
const JUMP_S = 1.5;
/** Catching up changes the speed by at most this share. */
const HASTE = 0.5;

/** Shows a live run a moment behind its newest sample, so that the arm moves evenly however samples arrive. */
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

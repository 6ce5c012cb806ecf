/** Time of the film: plays, pauses, jumps. It reads no clock of its own. */

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

/** What buttons, keys and tests ask of the player. */
import { stepSpeed } from "./clock.ts";
import { plateNumber, segmentAt } from "./format.ts";
import type { Follows, Player } from "./player.ts";

/** A frame of the film, for stepping [s]. */
const STEP_S = 1 / 30;
const COARSE_STEP_S = 1;
/** Later than this in a segment, “back” goes to its own start [s]. */
const INTO_S = 0.3;

export interface ControlsListener {
  /** Another moment, speed or motion is shown. */
  changed(): void;
  /** Someone went elsewhere: whatever marked a place no longer holds. */
  moved(): void;
}

export class Controls {
  readonly #player: Player;
  readonly #now: () => number;
  readonly #listener: ControlsListener;
  #held = false;
  /** Whether the film ran when it was held. */
  #resumes = false;

  constructor(player: Player, now: () => number, listener: ControlsListener) {
    this.#player = player;
    this.#now = now;
    this.#listener = listener;
  }

  get playing(): boolean {
    return this.#player.clock.playing || (this.#player.live && this.#player.newest);
  }

  /** Lets the film stand still, or go on if it ran before. */
  hold(on: boolean): void {
    if (on === this.#held) return;
    this.#held = on;
    if (on) {
      this.#resumes = this.playing;
      if (this.#resumes) this.pause();
    } else if (this.#resumes) this.play();
  }

  toggle(): void {
    if (this.playing) this.pause();
    else this.play();
  }

  play(): void {
    if (this.#held) return;
    this.#player.play(this.#now());
    this.#listener.moved();
    this.#listener.changed();
  }

  pause(): void {
    this.#player.pause(this.#now());
    this.#listener.changed();
  }

  seek(t: number): void {
    if (this.#held) return;
    this.#player.seek(t, this.#now());
    this.#listener.moved();
    this.#listener.changed();
  }

  step(direction: 1 | -1, coarse: boolean): void {
    this.#player.pause(this.#now());
    this.seek(this.#player.time + direction * (coarse ? COARSE_STEP_S : STEP_S));
  }

  toEnd(): void {
    if (this.#player.live) this.toNewest();
    else this.seek(this.#player.duration);
  }

  toNewest(): void {
    this.#player.toNewest();
    this.#listener.moved();
    this.#listener.changed();
  }

  /** To the start of the segment behind, or of this one or the one before. */
  toSegment(direction: 1 | -1): void {
    const { view, time, duration } = this.#player;
    const starts = view.segments.map(({ t_start_s }) => t_start_s);
    if (direction > 0) {
      this.seek(starts.find((t) => t > time + 1e-6) ?? duration);
      return;
    }
    const inside = segmentAt(view.segments, time, 0) >= 0;
    this.seek(starts.findLast((t) => t < time - (inside ? INTO_S : 1e-6)) ?? 0);
  }

  /** To the washing of a plate; its start [s], or null where it is not washed. */
  toPlate(plate: number): number | null {
    const segment = this.#player.view.segments.find((one) => one.kind === "wash" && one.plate === plate);
    if (segment === undefined) return null;
    this.seek(segment.t_start_s);
    return segment.t_start_s;
  }

  /** The plate whose name has this number; −1 where none has. */
  plateWith(number: string): number {
    const { plates } = this.#player.view;
    return plates.findIndex((_, k) => plateNumber(plates, k) === number);
  }

  setSpeed(speed: number): void {
    this.#player.clock.setSpeed(speed, this.#now());
    this.#listener.changed();
  }

  stepSpeed(up: boolean): void {
    this.setSpeed(stepSpeed(this.#player.clock.speed, up));
  }

  follow(motion: Follows): void {
    this.#player.follow(motion);
    this.#listener.changed();
  }

  heat(on: boolean): void {
    this.#player.shown.heat = on;
    this.#listener.changed();
  }
}

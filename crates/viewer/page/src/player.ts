/** What is shown at a time: the plan's motion or what the arm did, from the document and, while a run is live, from its samples. */
import { Clock, Follower } from "./clock.ts";
import { Clearances } from "./curves.ts";
import { segmentAt } from "./format.ts";
import type { LivePhase } from "./live.ts";
import { AXES, type JointState, Motion, newState } from "./motion.ts";
import { Recording } from "./recording.ts";
import type { Shown } from "./scene/index.ts";
import type { PlanSegment, View } from "./view.ts";

/** Whose joints the arm shows. */
export type Follows = "planned" | "executed";

/** A document and what is computed from it. */
interface Film {
  view: View;
  motion: Motion | null;
  recording: Recording | null;
  clearances: Clearances | null;
}

function filmOf(view: View): Film {
  return {
    view,
    motion: view.motion === null ? null : Motion.of(view.motion),
    recording: view.execution === null ? null : new Recording(view.execution),
    clearances: view.clearance === null ? null : new Clearances(view.clearance),
  };
}

/** When it ends [s]. */
function endOf({ motion, recording }: Film): number {
  return Math.max(motion?.duration ?? 0, recording?.end ?? 0);
}

export class Player {
  readonly clock: Clock;
  /** What the scene draws: the object and its arrays are used again for the next frame. */
  readonly shown: Shown;
  readonly #q = new Float64Array(AXES);
  readonly #plan: JointState = newState();
  readonly #follower = new Follower();
  #film: Film;
  #follows: Follows = "planned";
  #segment = 0;
  /** How a live run stands; null where the page shows none. */
  phase: LivePhase | null = null;
  /** Whether the newest moment of a live run is shown. */
  #newest = false;
  /** Where the last film stood, while there is none. */
  #waiting = { t: 0, playing: false };

  constructor(view: View) {
    this.#film = filmOf(view);
    this.clock = new Clock(endOf(this.#film));
    this.shown = {
      t_s: 0,
      q: this.#q,
      commanded: null,
      washing: null,
      clearance: null,
      coverageTime: 0,
      coverageKind: "planned",
      heat: false,
    };
    if (view.live !== null && this.recording !== null) {
      this.phase = "connecting";
      this.#newest = true;
      this.#follows = "executed";
    }
  }

  /** Shows another document, at the same time where its film goes as far. Without a film, time waits for the next one. */
  replace(view: View, now: number): void {
    const resting = this.duration === 0;
    const t = resting ? this.#waiting.t : this.time;
    const playing = resting ? this.#waiting.playing : this.clock.playing;
    this.#film = filmOf(view);
    this.#segment = 0;
    this.clock.setEnd(endOf(this.#film), t, now);
    this.#waiting = { t, playing };
    if (playing && this.time < this.duration) this.clock.play(now);
  }

  get view(): View {
    return this.#film.view;
  }

  get motion(): Motion | null {
    return this.#film.motion;
  }

  get recording(): Recording | null {
    return this.#film.recording;
  }

  get clearances(): Clearances | null {
    return this.#film.clearances;
  }

  get time(): number {
    return this.clock.time;
  }

  get duration(): number {
    return this.clock.end;
  }

  get follows(): Follows {
    return this.#follows;
  }

  follow(follows: Follows): void {
    if (follows === "planned" || this.recording !== null) this.#follows = follows;
  }

  /** Whether a live run is under way, so that there is nothing to show yet behind its newest sample. */
  get live(): boolean {
    return this.phase !== null && this.phase !== "done";
  }

  get newest(): boolean {
    return this.#newest;
  }

  /** The latest time that there is something to show of [s]. */
  get edge(): number {
    return this.live ? (this.recording?.end ?? 0) : this.duration;
  }

  /** How far the arm that is shown is behind the newest sample [s]. */
  get lag(): number {
    return Math.max(0, this.edge - this.time);
  }

  /** The segment at the time shown; null between segments. */
  get segment(): PlanSegment | null {
    const found = segmentAt(this.view.segments, this.time, this.#segment);
    if (found >= 0) this.#segment = found;
    return this.view.segments[found] ?? null;
  }

  /** Goes to where `now` [ms] has it; whether time changed. */
  tick(now: number): boolean {
    if (this.#newest && this.phase !== null) return this.#tickLive(now);
    const changed = this.clock.tick(now);
    if (changed && this.live && this.time >= this.edge) this.toNewest();
    return changed;
  }

  play(now: number): void {
    if (this.#newest) return;
    this.clock.play(now);
  }

  pause(now: number): void {
    if (this.#newest) this.seek(this.time, now);
    this.clock.pause(now);
  }

  seek(t: number, now: number): void {
    this.#newest = false;
    if (this.duration === 0 && Number.isFinite(t)) this.#waiting = { t, playing: false };
    this.clock.seek(Math.min(t, this.edge), now);
  }

  /** Shows the newest moment of a live run from now on. */
  toNewest(): void {
    if (!this.live) return;
    this.#newest = true;
    this.#follower.from(this.time);
  }

  /** What there is to show now. */
  show(): Shown {
    const { shown, time } = this;
    shown.t_s = time;
    const executed = this.jointsAt(time, this.#q);
    shown.commanded = executed && this.motion !== null ? this.motion.at(time, this.#plan).q : null;
    const segment = this.segment;
    shown.washing = segment?.kind === "wash" ? segment.plate : null;
    shown.clearance = this.clearances?.at(time) ?? null;
    shown.coverageTime = time;
    shown.coverageKind = this.coverageKind;
    return shown;
  }

  /** Whose coverage there is to show. */
  get coverageKind(): Follows {
    const executed = this.view.execution?.coverage ?? [];
    return this.#follows === "executed" && executed.length > 0 ? "executed" : "planned";
  }

  /** The joints that are shown [rad] at `t`, into `q`; whether they are what the arm did. */
  jointsAt(t: number, q: Float64Array): boolean {
    if (this.#follows === "executed" && this.recording?.positionAt(t, q) === true) return true;
    if (this.motion !== null) q.set(this.motion.at(t, this.#plan).q);
    else for (let j = 0; j < AXES; j++) q[j] = this.view.pose_rad[j] ?? 0;
    return false;
  }

  #tickLive(now: number): boolean {
    const before = this.time;
    const end = this.recording?.end ?? 0;
    const t = this.#follower.tick(now, end);
    this.clock.seek(t, now);
    if (this.phase === "done" && (t >= end || end - t < 0.2)) {
      this.clock.seek(end, now);
      this.#newest = false;
    }
    return this.time !== before;
  }
}

/** Frames: one after the other as the browser wants them, or one by one under a clock that a test holds. */

/** What of a frame takes how long. */
export interface FrameStatistics {
  /** Frames so far. */
  readonly count: number;
  /** Median time in scripts, drawing apart, of the last frames in which time ran [ms]. */
  readonly script_ms: number;
  readonly script_ms_most: number;
  /** Median time of drawing calls [ms]. */
  readonly draw_ms: number;
  /** From the start of navigation to the end of the first frame [ms]. */
  readonly first_ms: number;
}

const KEPT = 240;

/** The last so many numbers. */
class Window {
  readonly #values = new Float64Array(KEPT);
  #count = 0;

  push(value: number): void {
    this.#values[this.#count++ % KEPT] = value;
  }

  get sorted(): Float64Array {
    return this.#values.slice(0, Math.min(this.#count, KEPT)).sort();
  }

  get median(): number {
    const sorted = this.sorted;
    return sorted[sorted.length >> 1] ?? 0;
  }

  get most(): number {
    return this.sorted.at(-1) ?? 0;
  }
}

export interface FrameWork {
  /** Moves everything to `now` [ms]; whether time ran. */
  advance(now: number): boolean;
  /** Draws where there is something to draw; whether it did. */
  draw(): boolean;
}

export class Loop {
  readonly #work: FrameWork;
  readonly #script = new Window();
  readonly #draw = new Window();
  #count = 0;
  #first = Number.NaN;
  #last = 0;
  #clock: (() => number) | null = null;
  #request = 0;
  #afterFirst: (() => void) | null = null;

  constructor(work: FrameWork, afterFirst: () => void) {
    this.#work = work;
    this.#afterFirst = afterFirst;
  }

  /** Now [ms], by the clock that drives the frames. */
  now(): number {
    return this.#clock === null ? performance.now() : this.#clock();
  }

  start(): void {
    this.#request = requestAnimationFrame(this.#frame);
  }

  /** Another clock [ms]: frames come only by `step`; null for the browser's again. */
  setClock(clock: (() => number) | null): void {
    cancelAnimationFrame(this.#request);
    this.#clock = clock;
    if (clock === null) this.start();
  }

  /** One frame. */
  step(now = this.now()): void {
    const begun = performance.now();
    const ran = this.#work.advance(now);
    const moved = performance.now();
    const drawn = this.#work.draw();
    if (ran) this.#script.push(moved - begun);
    if (drawn) this.#draw.push(performance.now() - moved);
    this.#count++;
    if (this.#afterFirst === null) return;
    this.#first = performance.now();
    const after = this.#afterFirst;
    this.#afterFirst = null;
    after();
  }

  get statistics(): FrameStatistics {
    return {
      count: this.#count,
      script_ms: this.#script.median,
      script_ms_most: this.#script.most,
      draw_ms: this.#draw.median,
      first_ms: this.#first,
    };
  }

  /** The browser's stamp may precede a start that was after it: time does not run backwards. */
  readonly #frame = (stamp: number): void => {
    this.#request = requestAnimationFrame(this.#frame);
    this.#last = Math.max(this.#last, stamp);
    this.step(this.#last);
  };
}

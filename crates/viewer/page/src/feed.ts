/** A live run's samples on their way into the player and the scene. */
import { Live } from "./live.ts";
import { AXES } from "./motion.ts";
import type { Player } from "./player.ts";
import type { LiveEnd } from "./view.ts";

/** Least time between two changes of the path that is drawn [ms]. */
const DRAWN_MS = 200;

export interface FeedListener {
  changed(): void;
  /** New samples to draw: times [s] and joints [rad], six a time. */
  draw(times: Float64Array, positions: Float64Array): void;
  done(end: LiveEnd): void;
}

export class Feed {
  readonly #player: Player;
  readonly #listener: FeedListener;
  #drawn = 0;
  #at = Number.NEGATIVE_INFINITY;

  constructor(player: Player, listener: FeedListener) {
    this.#player = player;
    this.#listener = listener;
  }

  /** Listens to the run; nothing where the page shows none. */
  start(): void {
    const { view, recording } = this.#player;
    if (view.live === null || recording === null) return;
    const live = new Live(
      view.live.events,
      {
        phase: (phase) => {
          this.#player.phase = phase;
          this.#listener.changed();
        },
        samples: (rows) => {
          recording.append(rows);
        },
        done: (end) => this.#listener.done(end),
      },
      {
        open: (url) => new EventSource(url),
        later: (callback, after) => window.setTimeout(callback, after),
      },
    );
    live.start();
    addEventListener("pagehide", () => live.stop());
  }

  /** Hands on what has arrived, now and then. */
  flush(now: number): void {
    const recording = this.#player.recording;
    if (recording === null || recording.count === this.#drawn) return;
    if (now >= this.#at && now - this.#at < DRAWN_MS) return;
    this.#at = now;
    this.#listener.draw(recording.times.subarray(this.#drawn), recording.positions.subarray(AXES * this.#drawn));
    this.#drawn = recording.count;
  }
}

/** How a live run stands. */
import { fixed } from "../format.ts";
import type { LivePhase } from "../live.ts";
import type { Player } from "../player.ts";
import { announce, button, el, TextCell } from "./dom.ts";

const WORDS: Record<LivePhase, string> = {
  connecting: "connecting …",
  waiting: "waiting for the run to begin",
  running: "running",
  reconnecting: "connection lost: trying again …",
  done: "done",
};

export class Banner {
  readonly element: HTMLElement;
  readonly #player: Player;
  readonly #words = new TextCell();
  readonly #lag = new TextCell();
  readonly #back: HTMLButtonElement;
  #phase: LivePhase | null = null;

  constructor(player: Player, toNewest: () => void) {
    this.#player = player;
    this.#back = button({ class: "button text-button" }, toNewest, "Back to live");
    this.element = el(
      "div",
      { class: "banner" },
      el("span", { class: "banner-dot", set: { "aria-hidden": "true" } }),
      el("strong", {}, "LIVE"),
      el("span", {}, this.#words.node),
      el("span", { class: "banner-lag" }, this.#lag.node),
      this.#back,
    );
    this.element.hidden = player.phase === null;
  }

  update(): void {
    const { phase, live, newest, lag } = this.#player;
    if (phase === null) return;
    if (phase !== this.#phase) {
      this.#phase = phase;
      this.element.dataset["phase"] = phase;
      this.#words.set(WORDS[phase]);
      announce(`Live run: ${WORDS[phase]}`);
    }
    this.#back.hidden = !live || newest;
    this.#lag.set(live && lag > 0 ? `${fixed(lag, 1)} s behind` : "");
  }
}

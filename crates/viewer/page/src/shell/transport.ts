/** Play, pause, speed and time, with the scrubber. */
import { SPEEDS, stepSpeed } from "../clock.ts";
import { clockTime } from "../format.ts";
import type { Palette } from "../palette.ts";
import type { View } from "../view.ts";
import { button, byId, el, TextCell } from "./dom.ts";
import { icon } from "./icons.ts";
import { Scrubber, type ScrubberActions } from "./scrubber.ts";

export interface TransportActions extends ScrubberActions {
  toggle(): void;
  toStart(): void;
  /** To the segment before or behind. */
  segment(direction: 1 | -1): void;
  speed(speed: number): void;
}

const MULTIPLY = "\u202f×";

export class Transport {
  readonly #play: HTMLButtonElement;
  readonly #time = new TextCell();
  readonly #speed: HTMLSelectElement;
  readonly #other = el("option", { set: { hidden: "" } });
  readonly #scrubber: Scrubber;
  readonly #end = new TextCell();
  #duration = 0;
  #playing: boolean | null = null;

  constructor(view: View, duration: number, palette: Palette, actions: TransportActions) {
    this.#play = button({ class: "button play-button" }, () => actions.toggle());
    const options = SPEEDS.map((speed) => el("option", { set: { value: speed } }, `${speed}${MULTIPLY}`));
    this.#speed = el("select", { class: "speed", set: { "aria-label": "Speed" } }, ...options, this.#other);
    this.#speed.addEventListener("change", () => actions.speed(Number(this.#speed.value)));
    this.#scrubber = new Scrubber(view, duration, palette, actions);
    const root = byId("transport");
    root.replaceChildren(
      this.#scrubber.element,
      el(
        "div",
        { class: "controls" },
        button({ class: "button icon-button", label: "To the start (Home)" }, () => actions.toStart(), icon("first")),
        button({ class: "button icon-button", label: "Segment before" }, () => actions.segment(-1), icon("previous")),
        this.#play,
        button({ class: "button icon-button", label: "Next segment" }, () => actions.segment(1), icon("next")),
        el("span", { class: "time" }, el("span", { class: "time-now" }, this.#time.node), " / ", this.#end.node),
        el(
          "span",
          { class: "speeds" },
          button({ class: "button bare-button", label: "Slower ([)" }, () => actions.speed(stepSpeed(Number(this.#speed.value), false)), "−"),
          this.#speed,
          button({ class: "button bare-button", label: "Faster (])" }, () => actions.speed(stepSpeed(Number(this.#speed.value), true)), "+"),
        ),
      ),
    );
    this.setSpeed(1);
    this.setPlaying(false);
    this.#setDuration(duration);
  }

  /** Shows the time of another document. */
  replace(view: View, duration: number): void {
    this.#setDuration(duration);
    this.#scrubber.replace(view, duration);
  }

  #setDuration(duration: number): void {
    this.#duration = duration;
    this.#end.set(`${clockTime(duration, duration)} s`);
    byId("transport").classList.toggle("no-film", duration === 0);
    this.#play.disabled = duration === 0;
  }

  update(t: number, edge: number, now: number): void {
    this.#time.set(clockTime(t, this.#duration));
    this.#scrubber.update(t, edge, now);
  }

  setPlaying(playing: boolean): void {
    if (playing === this.#playing) return;
    this.#playing = playing;
    const label = playing ? "Pause (Space)" : "Play (Space)";
    this.#play.replaceChildren(icon(playing ? "pause" : "play"));
    this.#play.setAttribute("aria-label", label);
    this.#play.title = label;
  }

  setSpeed(speed: number): void {
    const listed = SPEEDS.some((one) => one === speed);
    this.#other.value = String(speed);
    this.#other.textContent = `${Number(speed.toFixed(2))}${MULTIPLY}`;
    this.#other.hidden = listed;
    this.#speed.value = String(speed);
  }

  setPalette(palette: Palette): void {
    this.#scrubber.setPalette(palette);
  }
}

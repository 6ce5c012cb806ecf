/** “See the proof”: the film runs through, arm and tool leave the volume that they sweep, each requirement is ticked where it is worst, and a card ends it. */
import type { Controls } from "../controls.ts";
import { measureWords } from "../limits.ts";
import { AXES } from "../motion.ts";
import type { Player } from "../player.ts";
import type { Scene } from "../scene/index.ts";
import { statusWord } from "../verdict.ts";
import type { Check, View } from "../view.ts";
import { ProofCard } from "./card.ts";
import { announce, button, el, isolated, TextCell, toneIcon } from "./dom.ts";

/** Moments of the volume. */
const MOMENTS = 48;
/** How long the film takes [s], without its stops. */
const FILM_S = 12;
/** How long it stops where a requirement is worst [ms]. */
const STOP_MS = 850;

/** Whether a view has what a tour needs. */
export function canTour(view: View): boolean {
  return view.certificate !== null && view.motion !== null;
}

/** The requirements that are worst at a time, in order of it. */
export function stopsOf(checks: readonly Check[]): Check[] {
  const timed = checks.filter(({ worst }) => worst.time_s !== undefined);
  return timed.sort((a, b) => a.worst.time_s! - b.worst.time_s!);
}

export class Tour {
  readonly button = button({ class: "button text-button", title: "The swept volume, and each requirement at its worst place" }, () => this.#start(), "See the proof");
  /** How far it is. */
  readonly element = el("div", { class: "tour", set: { role: "status" } });
  readonly label = el("div", { class: "tour-label" });
  readonly #count = new TextCell();
  readonly #player: Player;
  readonly #controls: Controls;
  readonly #scene: Scene;
  readonly #mark: (check: Check | null) => void;
  readonly #card = new ProofCard(() => this.stop());
  #stops: Check[] = [];
  #next = 0;
  #running = false;
  /** Of the film before. */
  #speed = 1;
  /** Until when the film stands still [ms]; null while it runs. */
  #until: number | null = null;
  #at: Check | null = null;

  constructor(player: Player, controls: Controls, scene: Scene, mark: (check: Check | null) => void) {
    this.#player = player;
    this.#controls = controls;
    this.#scene = scene;
    this.#mark = mark;
    const words = `The volume is drawn from ${MOMENTS} moments. The proof holds at every moment.`;
    this.element.append(el("strong", {}, this.#count.node), el("p", {}, words), button({ class: "button text-button" }, () => this.stop(), "Stop (Esc)"));
    this.element.hidden = this.label.hidden = true;
    document.addEventListener("keydown", (event) => {
      if (event.key === "Escape" && this.#running) this.stop();
    });
    this.replaced();
  }

  /** The player shows another document. */
  replaced(): void {
    this.stop();
    this.button.hidden = !canTour(this.#player.view);
  }

  #start(): void {
    const { view, duration } = this.#player;
    if (!canTour(view)) return;
    this.stop();
    const rows = new Float64Array(MOMENTS * AXES);
    for (let k = 0; k < MOMENTS; k++) this.#player.plannedAt((duration * k) / (MOMENTS - 1), rows.subarray(k * AXES, (k + 1) * AXES));
    this.#scene.showSwept(rows);
    this.#stops = stopsOf(view.certificate!.checks);
    this.#next = 0;
    this.#running = true;
    this.element.hidden = false;
    this.#controls.follow("planned");
    this.#speed = this.#player.clock.speed;
    this.#controls.setSpeed(Math.max(1, duration / FILM_S));
    this.#controls.seek(0);
    this.#controls.play();
    announce("The proof begins");
  }

  stop(): void {
    this.#card.close();
    if (!this.#running) return;
    this.#running = false;
    this.element.hidden = this.label.hidden = true;
    this.#until = this.#at = null;
    this.#scene.showSwept(null);
    this.#controls.pause();
    this.#controls.setSpeed(this.#speed);
    this.#mark(null);
  }

  /** Goes on to `now` [ms]. */
  advance(now: number): void {
    if (!this.#running) return;
    const { time, duration, view } = this.#player;
    this.#scene.sweptUntil(duration > 0 ? time / duration : 1);
    this.#place();
    if (this.#until !== null) {
      if (now < this.#until) return;
      this.#until = null;
      if (this.#next < this.#stops.length || time < duration) this.#controls.play();
    }
    const stop = this.#stops[this.#next];
    this.#count.set(`${this.#next} of ${this.#stops.length} requirements ticked where they are worst`);
    if (stop !== undefined && time >= stop.worst.time_s! - 1e-9) {
      this.#next++;
      this.#show(stop, now);
    } else if (stop === undefined && time >= duration) {
      this.label.hidden = this.element.hidden = true;
      this.#mark(null);
      this.#card.show(view, this.#scene.picture(1.5));
      this.#until = Number.POSITIVE_INFINITY;
    }
  }

  /** Stops at the worst place of a requirement. */
  #show(check: Check, now: number): void {
    this.#controls.pause();
    this.#controls.seek(check.worst.time_s!);
    this.#mark(check);
    this.#at = check;
    const measure = check.measure === undefined ? statusWord(check.status) : measureWords(check.measure);
    this.label.className = `tour-label tone-${check.status}`;
    this.label.replaceChildren(toneIcon(check.status), el("span", {}, isolated(check.words), " "), el("strong", {}, measure));
    this.label.hidden = false;
    this.#until = now + STOP_MS;
    this.#place();
  }

  /** Keeps the label at its place. */
  #place(): void {
    const place = this.#at?.worst.place_m ?? this.#scene.tip();
    const [x, y] = this.#scene.project(place) ?? [0, 0];
    this.label.style.translate = `${x.toFixed(0)}px ${y.toFixed(0)}px`;
  }
}

/** “See the proof”: the film runs through, arm and tool leave the volume that they sweep, each requirement is ticked where it is worst, and a card ends it. */
import type { Controls } from "../controls.ts";
import { measureWords } from "../limits.ts";
import { newState } from "../motion.ts";
import type { Player } from "../player.ts";
import { type Scene, SweptVolume } from "../scene/index.ts";
import { statusWord } from "../verdict.ts";
import type { Check, View } from "../view.ts";
import { ProofCard } from "./card.ts";
import { button, el, isolated, TextCell, toneIcon } from "./dom.ts";

/** Moments of the volume. */
const MOMENTS = 48;
/** How long the film takes [s], without its stops. */
const FILM_S = 12;
/** How far the label is from its place, on both of its sides together [px]. */
const BESIDE_PX = 28;
/** How long it stops where a requirement is worst [ms]. */
const STOP_MS = 850;

/** Whether a view has what a tour needs. */
export function canTour(view: View): boolean {
  return view.certificate !== null && view.motion !== null;
}

/** The requirements that are worst at a time [s], in order of it; those that are worst at a place alone in the end. */
export function stopsOf(checks: readonly Check[], end: number): { check: Check; t: number }[] {
  const placed = checks.filter(({ worst }) => worst.time_s !== undefined || worst.place_m !== undefined);
  return placed.map((check) => ({ check, t: check.worst.time_s ?? end })).sort((a, b) => a.t - b.t);
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
  #stops: ReturnType<typeof stopsOf> = [];
  #next = 0;
  /** While the tour runs. */
  #volume: SweptVolume | null = null;
  /** Speed of the film before. */
  #speed = 1;
  /** Until when the film stands still [ms]. */
  #until = 0;
  #at: Check | null = null;

  constructor(player: Player, controls: Controls, scene: Scene, mark: (check: Check | null) => void) {
    this.#player = player;
    this.#controls = controls;
    this.#scene = scene;
    this.#mark = mark;
    const words = `The volume is drawn from ${MOMENTS} moments. The proof holds at every moment.`;
    this.element.append(el("strong", {}, this.#count.node), el("p", {}, words), button({ class: "button text-button" }, () => this.stop(), "Stop (Esc)"));
    this.#hide();
    document.addEventListener("keydown", ({ key }) => {
      if (key === "Escape") this.stop();
    });
    this.replaced();
  }

  /** The player shows another document. */
  replaced(): void {
    this.stop();
    this.button.hidden = !canTour(this.#player.view);
  }

  #hide(): void {
    this.element.hidden = this.label.hidden = true;
  }

  #start(): void {
    const { view, motion, duration, clock } = this.#player;
    this.stop();
    const at = (k: number): Float64Array => motion!.at((duration * k) / (MOMENTS - 1), newState()).q;
    const rows = Float64Array.from(Array.from({ length: MOMENTS }, (_, k) => [...at(k)]).flat());
    this.#volume = this.#scene.swap(null, () => new SweptVolume(view, rows));
    this.#stops = stopsOf(view.certificate?.checks ?? [], duration);
    this.#next = this.#until = 0;
    this.element.hidden = false;
    this.#speed = clock.speed;
    this.#controls.follow("planned");
    this.#controls.setSpeed(Math.max(1, duration / FILM_S));
    this.#controls.seek(0);
    this.#controls.play();
  }

  stop(): void {
    this.#card.close();
    if (this.#volume === null) return;
    this.#volume = this.#scene.swap(this.#volume, null);
    this.#hide();
    this.#controls.pause();
    this.#controls.setSpeed(this.#speed);
    this.#mark(null);
  }

  /** Goes on to `now` [ms]. */
  advance(now: number): void {
    if (this.#volume === null) return;
    const { time, duration, view } = this.#player;
    this.#volume.until(time / duration);
    this.#count.set(`${this.#next} of ${this.#stops.length} requirements ticked where they are worst`);
    this.#place();
    if (now < this.#until) return;
    if (this.#until > 0 && time < duration) this.#controls.play();
    this.#until = 0;
    const stop = this.#stops[this.#next];
    if (stop !== undefined && time >= stop.t - 1e-9) this.#show(stop.check, stop.t, now);
    else if (stop === undefined && time >= duration) {
      this.#until = Number.POSITIVE_INFINITY;
      this.#hide();
      this.#mark(null);
      this.#card.show(view, this.#scene.picture(1.5));
    }
  }

  /** Stops at the worst place of a requirement. */
  #show(check: Check, t: number, now: number): void {
    this.#next++;
    this.#controls.pause();
    this.#controls.seek(t);
    this.#mark(check);
    this.#at = check;
    const measure = check.measure === undefined ? statusWord(check.status) : measureWords(check.measure);
    this.label.className = `tour-label tone-${check.status}`;
    this.label.replaceChildren(toneIcon(check.status), el("span", {}, isolated(check.words), " "), el("strong", {}, measure));
    this.label.hidden = false;
    this.#until = now + STOP_MS;
    this.#place();
  }

  /** Keeps the label beside its place. */
  #place(): void {
    const [x, y] = this.#scene.project(this.#at?.worst.place_m ?? this.#scene.tip()) ?? [0, 0];
    const [room, width] = [this.label.parentElement?.clientWidth ?? 0, this.label.offsetWidth + BESIDE_PX];
    const left = Math.max(0, Math.min(x > room / 2 ? x - width : x, room - width));
    this.label.style.translate = `${left.toFixed(0)}px ${y.toFixed(0)}px`;
  }
}

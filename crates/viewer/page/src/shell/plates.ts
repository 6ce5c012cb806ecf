/** Each plate's coverage: a map that builds up as time runs, and how much of the plate that is. */
import { cssGradient, decodeCoverage, dwellScale, PlateMap, shareAt, type Coverage } from "../coverage.ts";
import { cleanShare } from "../dirt.ts";
import { fixedShort, percentDown, plateName, quantity } from "../format.ts";
import type { Follows, Player } from "../player.ts";
import type { PlateCoverage } from "../view.ts";
import { button, el, isolated, TextCell } from "./dom.ts";

/** Least time between two paintings [ms]. */
const PAINT_MS = 120;
/** Cards that are painted before the browser has said which are in sight. */
const FIRST_SEEN = 8;

interface Card {
  plate: number;
  element: HTMLElement;
  canvas: HTMLCanvasElement;
  share: TextCell;
  bar: HTMLElement;
  maps: Partial<Record<Follows, PlateMap>>;
  /** Whether the card is in sight. */
  seen: boolean;
}

/** What maps show, in a sentence. */
export function meaning(coverages: readonly Coverage[]): string {
  const counted = coverages.map((coverage) => coverage.counted);
  const promised = counted.find((one) => one?.is_promised);
  if (promised) {
    const mm = (length: number): string => `${fixedShort(1000 * length, 2)}\u202fmm`;
    const errors = counted.flatMap((one) => (one?.is_promised ? [one.height_error_m] : []));
    const [least, most] = [Math.min(...errors), Math.max(...errors)];
    const error = least === most ? `±${mm(most)}` : `its height error (±${mm(least)} to ±${mm(most)})`;
    return `Coloured where the sponge is pressed by ${mm(promised.compression_m)} or more, wherever within ${error} the plate lies.`;
  }
  if (counted.length > 0 && counted.every((one) => one !== null)) return "Coloured where the sponge touches the face.";
  return "Coloured where the sponge was over the face.";
}

/** Coverage of every plate, planned and executed. */
export class Coverages {
  readonly #documents: Record<Follows, readonly PlateCoverage[]>;

  constructor(planned: readonly PlateCoverage[], executed: readonly PlateCoverage[]) {
    this.#documents = { planned, executed };
  }

  get plates(): number[] {
    return this.#documents.planned.map(({ plate }) => plate);
  }

  get all(): Coverage[] {
    return this.#documents.planned.map(decodeCoverage);
  }

  of(plate: number, kind: Follows): Coverage | null {
    const document = this.#documents[kind].find((one) => one.plate === plate);
    return document === undefined ? null : decodeCoverage(document);
  }

  shareAt(plate: number, kind: Follows, t: number): number | null {
    const coverage = this.of(plate, kind);
    return coverage === null ? null : shareAt(coverage, t);
  }
}

export class Plates {
  readonly element = el("div", { class: "plates" });
  readonly #player: Player;
  #coverages: Coverages;
  readonly #onPlate: (plate: number) => void;
  /** Of the heat map's colours. */
  readonly scale = el("p", { class: "heat-scale" });
  #observer: IntersectionObserver | null = null;
  #cards: Card[] | null = null;
  #dwell_s = 1;
  #painted = Number.NEGATIVE_INFINITY;

  constructor(player: Player, coverages: Coverages, onPlate: (plate: number) => void) {
    this.#player = player;
    this.#coverages = coverages;
    this.#onPlate = onPlate;
    this.scale.hidden = true;
  }

  /** The player shows another document: its plates are painted when they are shown. */
  replace(coverages: Coverages): void {
    this.#coverages = coverages;
    this.scale.hidden = true;
    this.#observer?.disconnect();
    this.#cards = null;
  }

  show(): void {
    if (this.#cards === null) this.#make();
    this.update(0, true);
  }

  /** Paints what is in sight and has changed. */
  update(now: number, anew: boolean): void {
    if (this.#cards === null) return;
    if (!anew && now >= this.#painted && now - this.#painted < PAINT_MS) return;
    this.#painted = now;
    const { time, coverageKind, shown } = this.#player;
    for (const card of this.#cards) if (card.seen) this.#paint(card, time, coverageKind, shown.heat);
  }

  /** Shows or hides the scale of the heat map, which lies over the scene. */
  showScale(on: boolean): void {
    if (on === !this.scale.hidden) return;
    this.scale.hidden = !on;
    if (!on) return;
    const { all } = this.#coverages;
    const heat = el("span", { class: "heat-bar", set: { "aria-hidden": "true" } });
    heat.style.background = cssGradient();
    const what = all.every(({ counted }) => counted !== null) ? "in contact for 0 s" : "under the sponge for 0 s";
    this.scale.replaceChildren(el("span", {}, what), heat, el("span", {}, quantity(dwellScale(all), 1, "s and more")));
  }

  /** Paints all, in sight or not. */
  print(): void {
    if (this.#cards === null) this.#make();
    const { time, coverageKind, shown } = this.#player;
    for (const card of this.#cards ?? []) this.#paint(card, time, coverageKind, shown.heat);
  }

  #paint(card: Card, t: number, kind: Follows, heat: boolean): void {
    const coverage = this.#coverages.of(card.plate, kind);
    if (coverage === null) return;
    card.maps[kind] ??= new PlateMap(card.canvas, coverage, this.#dwell_s);
    const other = card.maps[kind === "planned" ? "executed" : "planned"];
    if (other !== undefined) delete card.maps[kind === "planned" ? "executed" : "planned"];
    card.maps[kind].paint(t, heat ? "dwell" : "build-up");
    // The heat map is that of the whole motion.
    const share = shareAt(coverage, heat ? Number.POSITIVE_INFINITY : t);
    card.share.set(percentDown(share));
    card.bar.style.transform = `scaleX(${share.toFixed(4)})`;
  }

  #make(): void {
    this.#dwell_s = dwellScale(this.#coverages.all);
    const order = this.#player.view.paths.map((path) => path.plate);
    const plates = this.#coverages.plates.sort((a, b) => order.indexOf(a) - order.indexOf(b));
    this.#cards = plates.map((plate, k) => this.#card(plate, k < FIRST_SEEN));
    this.#observer = new IntersectionObserver((entries) => {
      for (const entry of entries) {
        const card = this.#cards?.find(({ element }) => element === entry.target);
        if (card !== undefined) card.seen = entry.isIntersecting;
      }
      this.update(0, true);
    });
    for (const { element } of this.#cards) this.#observer.observe(element);
    const inAir = this.#player.view.heading.dry_run === null ? "" : "Nothing is washed: what the sponge goes over in the air. ";
    const doses = new Set(this.#player.view.dirt.map(({ dose_pa_m: dose, soil }) => `${fixedShort(dose, 1)}\u202fPa·m${soil === undefined ? "" : ` (${soil})`}`));
    const dirtWords = doses.size === 0 ? "" : ` Dirt in the scene lies until a dose of ${[...doses].join(" or ")} is proved there: what stays dirty is not proved clean.`;
    const words = `${inAir}In the order of washing. ${meaning(this.#coverages.all)} Sampled on a raster to look at; what is proved is below each map.${dirtWords}`;
    if (this.#cards.length === 0) return this.element.replaceChildren(el("p", { class: "summary" }, "No plate is washed: there is no plan."));
    this.element.replaceChildren(
      el("p", { class: "summary" }, words),
      el("ul", { class: "cards" }, ...this.#cards.map(({ element }) => element)),
    );
  }

  #card(plate: number, seen: boolean): Card {
    const name = plateName(this.#player.view.plates, plate);
    const canvas = el("canvas", { class: "map", set: { role: "img", "aria-label": `What the sponge sweeps of ${name}` } });
    const share = new TextCell("0\u202f%");
    const bar = el("span", { class: "bar-fill" });
    const final = this.#coverages.shareAt(plate, this.#player.coverageKind, Number.POSITIVE_INFINITY) ?? 0;
    const { proved = null, counted = null } = this.#coverages.of(plate, "planned") ?? {};
    const last = proved === null ? `in the end ${percentDown(final)}` : `proved: ${counted?.is_promised ? "pressed" : "swept"} ≥\u202f${percentDown(proved)}`;
    const clean = cleanShare(this.#player.view, plate, Number.POSITIVE_INFINITY);
    const go = button({ class: "card-button", label: `Go to the washing of ${name}` }, () => this.#onPlate(plate), canvas);
    const own = this.#player.view.plates[plate]?.own;
    const element = el(
      "li",
      { class: "card" },
      go,
      el("div", { class: "card-words" }, isolated(name, { class: "card-name" }), el("strong", {}, share.node)),
      el("div", { class: "bar", set: { "aria-hidden": "true" } }, bar),
      el("p", { class: "card-proved" }, clean === null ? last : `${last}, clean ≥\u202f${percentDown(clean)}`),
      ...(own === undefined ? [] : [el("p", { class: "card-proved" }, isolated(own))]),
    );
    return { plate, element, canvas, share, bar, maps: {}, seen };
  }
}

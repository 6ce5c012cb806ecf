/** The plan and another program on one clock: a button that shows both cells, and how much of the plates each has done by now. */
import { type Coverage, decodeCoverage, shareAt } from "../coverage.ts";
import { percentDown, quantity } from "../format.ts";
import type { Player } from "../player.ts";
import { BesideCell, type Scene } from "../scene/index.ts";
import type { Beside, PlateCoverage } from "../view.ts";
import { button, el, TextCell } from "./dom.ts";

const MEANING = "Share of all plates: pressed by the plan; under a sponge of 25 mm by the program, in contact or not.";

/** Share of all plates at `t` [s], by their areas. */
function shareOfAll(coverage: readonly Coverage[], t: number): number {
  const sum = (of: (one: Coverage) => number): number => coverage.reduce((all, one) => all + one.half_m ** 2 * of(one), 0);
  return coverage.length === 0 ? 0 : sum((one) => shareAt(one, t)) / sum(() => 1);
}

/** A row with a bar, and what sets it to a time [s]. */
function row(name: string, tone: string, documents: readonly PlateCoverage[]): { element: HTMLElement; set(t: number): void } {
  const [bar, share, coverage] = [el("span", { class: "bar-fill" }), new TextCell(), documents.map(decodeCoverage)];
  const set = (t: number): void => {
    const done = shareOfAll(coverage, t);
    bar.style.transform = `scaleX(${done.toFixed(4)})`;
    share.set(percentDown(done));
  };
  return { element: el("div", { class: `beside-row ${tone}` }, el("span", {}, name), el("div", { class: "bar" }, bar), el("strong", {}, share.node)), set };
}

export class BesidePanel {
  readonly button: HTMLButtonElement;
  readonly element: HTMLElement;
  readonly #show: (t: number) => void;
  readonly #player: Player;
  #cell: BesideCell | null = null;

  constructor(player: Player, beside: Beside, scene: Scene, changed: () => void) {
    this.#player = player;
    const { view } = player;
    const rows = [row("This plan", "", view.coverage), row("Paper’s program", "unproved", beside.coverage)];
    const note = new TextCell();
    this.element = el("div", { class: "beside" }, ...rows.map(({ element }) => element), el("p", {}, note.node));
    this.element.hidden = true;
    this.#show = (t) => {
      for (const { set } of rows) set(t);
      note.set(t < beside.duration_s ? MEANING : `It ended at ${quantity(beside.duration_s, 2, "s")}. ${beside.headline}`);
    };
    this.button = button({ class: "button text-button", title: "The paper’s program beside this plan, on one clock", set: { "aria-pressed": "false" } }, () => {
      const on = this.#cell === null;
      this.#cell = scene.swap(this.#cell, on ? ({ extent }, studio, retired) => new BesideCell(view, beside, extent, studio, retired) : null);
      this.element.hidden = !on;
      this.button.setAttribute("aria-pressed", String(on));
      changed();
    }, "Beside the paper");
  }

  /** Shows the moment. */
  update(): void {
    if (this.#cell === null) return;
    this.#cell.show(this.#player.time);
    this.#show(this.#player.time);
  }
}

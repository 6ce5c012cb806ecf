/** The plan and another program on one clock: a button that shows both cells, and how much of the plates each has washed by now. */
import { percentDown, quantity } from "../format.ts";
import { meaning } from "./plates.ts";
import { type Coverage, decodeCoverage, shareAt } from "../coverage.ts";
import type { Player } from "../player.ts";
import type { Scene } from "../scene/index.ts";
import type { Beside } from "../view.ts";
import { button, el, TextCell } from "./dom.ts";

interface Row {
  element: HTMLElement;
  coverage: Coverage[];
  bar: HTMLElement;
  share: TextCell;
}

function rowOf(name: string, coverage: Coverage[], title: string, tone = ""): Row {
  const [bar, share] = [el("span", { class: "bar-fill" }), new TextCell()];
  const element = el("div", { class: `beside-row ${tone}`, title }, el("span", {}, name), el("div", { class: "bar" }, bar), el("strong", {}, share.node));
  return { element, coverage, bar, share };
}

/** Share of all plates, by their areas. */
function shareOfAll(coverage: readonly Coverage[], t: number): number {
  const area = ({ half_m }: Coverage): number => half_m * half_m;
  const all = coverage.reduce((sum, one) => sum + area(one), 0);
  return all > 0 ? coverage.reduce((sum, one) => sum + area(one) * shareAt(one, t), 0) / all : 0;
}

export class BesidePanel {
  readonly button: HTMLButtonElement;
  readonly element = el("div", { class: "beside" });
  readonly #rows: Row[];
  readonly #note: TextCell = new TextCell();
  readonly #beside: Beside;
  readonly #player: Player;
  readonly #scene: Scene;

  constructor(player: Player, beside: Beside, scene: Scene, changed: () => void) {
    this.#player = player;
    this.#beside = beside;
    this.#scene = scene;
    const [own, other] = [player.view.coverage, beside.coverage].map((list) => list.map(decodeCoverage));
    const title = "No sponge is in the program: it counts what a sponge of 25 mm would be over, in contact or not.";
    this.#rows = [rowOf("This plan", own!, meaning(own!)), rowOf("Paper’s program", other!, title, "unproved")];
    this.element.append(...this.#rows.map(({ element }) => element), el("p", {}, this.#note.node));
    this.element.hidden = true;
    this.button = button({ class: "button text-button", title: "The paper’s program beside this plan, on one clock", set: { "aria-pressed": "false" } }, () => {
      const on = this.element.hidden;
      this.element.hidden = !on;
      this.button.setAttribute("aria-pressed", String(on));
      scene.showBeside(on ? beside : null);
      changed();
    }, "Beside the paper");
  }

  /** Shows the moment. */
  update(): void {
    if (this.element.hidden) return;
    const { time } = this.#player;
    this.#scene.besideAt(time);
    for (const { coverage, bar, share } of this.#rows) {
      const done = shareOfAll(coverage, time);
      bar.style.transform = `scaleX(${done.toFixed(4)})`;
      share.set(percentDown(done));
    }
    const { headline, duration_s } = this.#beside;
    this.#note.set(time < duration_s ? "Share of all plates: pressed by the plan; under a sponge of 25 mm by the program." : `It ended at ${quantity(duration_s, 2, "s")}. ${headline}`);
  }
}

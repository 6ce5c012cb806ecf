/** The playground between page and engine: its tools, and the link in the page's address, which always leads to the cell that is shown. */
import type { Channel } from "../edit/channel.ts";
import type { Playground, PlaygroundCell } from "../edit/editor.ts";
import { button, byId, el, icon, isolated } from "../shell/dom.ts";
import { type CellLink, linkedCell, LinkError, packed, unpacked } from "./link.ts";
import { type ShippedScenario, Tools } from "./tools.ts";

/** How long a text stands before it goes into the address [ms]. */
const SETTLED_MS = 300;

const SAME = (one: CellLink | null, other: CellLink | null): boolean => JSON.stringify(one) === JSON.stringify(other);

export class OpenPlayground implements Playground {
  readonly channel: Channel;
  readonly #shipped: readonly ShippedScenario[];
  #cell: PlaygroundCell | null = null;
  #tools: Tools | null = null;
  #text = "";
  /** In the address. */
  #link: CellLink | null = linkedCell(location.hash);
  #timer = 0;
  /** What is wrong with the address that the page was opened at. */
  #wrong: string | null = null;
  /** Says that something is wrong with a link. */
  #bar: HTMLElement | null = null;

  constructor(channel: Channel, shipped: readonly ShippedScenario[]) {
    this.channel = channel;
    this.#shipped = shipped;
    addEventListener("hashchange", () => void this.#follow());
  }

  /** The text that the address names; where it names none, or a wrong one, the first shipped one. */
  async linkedText(): Promise<string> {
    const [fallback] = this.#shipped;
    try {
      return (await this.#textOf(this.#link)) ?? fallback!.text;
    } catch (error) {
      if (!(error instanceof LinkError)) throw error;
      this.#wrong = `${error.message} “${fallback!.name}” is shown instead.`;
      return fallback!.text;
    }
  }

  begin(cell: PlaygroundCell): HTMLElement[] {
    this.#cell = cell;
    if (this.#wrong !== null) this.#complain(this.#wrong);
    this.#tools = new Tools(this.channel, cell, this.#shipped, () => this.#write());
    return this.#tools.elements;
  }

  changed(text: string): void {
    if (text === this.#text) return;
    if (this.#text !== "") this.#bar?.remove();
    this.#text = text;
    clearTimeout(this.#timer);
    this.#timer = window.setTimeout(() => void this.#write(), SETTLED_MS);
  }

  save(): void {
    void this.#tools?.download("scenario");
  }

  /** Writes the link to the text into the address. */
  async #write(): Promise<void> {
    const text = this.#text;
    const shipped = this.#shipped.find((one) => one.text === text);
    const link = shipped === undefined ? { cell: await packed(text) } : { scenario: shipped.name };
    if (text !== this.#text) return;
    this.#link = link;
    this.#cell?.link(link);
  }

  /** Somebody has opened another link in this tab. */
  async #follow(): Promise<void> {
    const link = linkedCell(location.hash);
    if (link === null || SAME(link, this.#link)) return;
    this.#link = link;
    try {
      const text = await this.#textOf(link);
      if (text !== null) this.#cell?.take(text, "Open the link");
    } catch (error) {
      if (!(error instanceof LinkError)) throw error;
      this.#complain(error.message);
    }
  }

  /** The text of a link; null for none. `LinkError` where it cannot be read. */
  async #textOf(link: CellLink | null): Promise<string | null> {
    if (link === null) return null;
    if ("cell" in link) return unpacked(link.cell);
    const named = this.#shipped.find(({ name }) => name === link.scenario);
    if (named === undefined) throw new LinkError(`No scenario “${link.scenario.slice(0, 40)}” comes with platewash.`);
    return named.text;
  }

  /** Says that something is wrong with a link, until it is closed or another scenario stands. */
  #complain(words: string): void {
    this.#bar?.remove();
    const close = button({ class: "button bare-button", label: "Close" }, () => this.#bar?.remove(), icon("cross"));
    this.#bar = el("div", { class: "edit-bar notice tone-not_proved", set: { role: "alert" } }, icon("question"), el("p", {}, isolated(words)), close);
    byId("header").append(this.#bar);
  }
}

/** The playground between page and engine: its tools, and the link in the page's address, which leads to the cell that is shown. */
import type { Channel } from "../edit/channel.ts";
import type { Playground, PlaygroundCell } from "../edit/editor.ts";
import { button, byId, el, icon, isolated } from "../shell/dom.ts";
import { type CellLink, linkedCell, LinkError, packed, unpacked } from "./link.ts";
import { type ShippedScenario, Tools } from "./tools.ts";

/** How long a text stands before it goes into the address [ms]. */
const SETTLED_MS = 300;

export class BrowserPlayground implements Playground {
  readonly channel: Channel;
  readonly #shipped: readonly ShippedScenario[];
  #cell: PlaygroundCell | null = null;
  #tools: Tools | null = null;
  #text = "";
  #timer = 0;
  /** Counts links that were followed: the last one counts. */
  #followed = 0;
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
      return (await this.#textOf(linkedCell(location.hash))) ?? fallback!.text;
    } catch (error) {
      if (!(error instanceof LinkError)) throw error;
      this.#wrong = `${error.message} “${fallback!.name}” is shown instead.`;
      return fallback!.text;
    }
  }

  begin(cell: PlaygroundCell): HTMLElement[] {
    this.#cell = cell;
    if (this.#wrong !== null) this.#complain(this.#wrong);
    this.#tools = new Tools(this.channel, cell, this.#shipped, (text) => this.#address(text));
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

  /** The link to a text: by name where it is a shipped one. */
  async #linkTo(text: string): Promise<CellLink> {
    const shipped = this.#shipped.find((one) => one.text === text);
    return shipped === undefined ? { cell: await packed(text) } : { scenario: shipped.name };
  }

  /** The address of this page with a text. */
  async #address(text: string): Promise<string> {
    const address = new URL(location.href);
    address.hash = String(new URLSearchParams({ ...(await this.#linkTo(text)) }));
    return address.href;
  }

  /** Writes the link to the text that stands into the address. */
  async #write(): Promise<void> {
    const text = this.#text;
    const link = await this.#linkTo(text);
    if (text === this.#text) this.#cell?.link(link);
  }

  /** The address has changed: another link was opened in this tab, or the page was left for a place within it. */
  async #follow(): Promise<void> {
    const number = ++this.#followed;
    const cell = this.#cell;
    try {
      const text = await this.#textOf(linkedCell(location.hash));
      if (number !== this.#followed || cell === null) return;
      if (text === null) await this.#write();
      else if (text !== cell.commit()) cell.take(text, "Open the link");
    } catch (error) {
      if (!(error instanceof LinkError)) throw error;
      await this.#write();
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

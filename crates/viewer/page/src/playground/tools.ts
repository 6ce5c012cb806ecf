/** Tools of the playground: scenarios to choose from, a file to open, files to take home, and a link to the cell. */
import type { Channel } from "../edit/channel.ts";
import type { PlaygroundCell } from "../edit/editor.ts";
import { button, el, icon } from "../shell/dom.ts";
import { download, FILES, type FileKind, filesOf, scenarioFile } from "./files.ts";
import { MOST_BYTES } from "./link.ts";

/** A scenario that comes with the program. */
export interface ShippedScenario {
  name: string;
  about: string;
  /** Whether it is the paper's program, which a live cell does not run. */
  is_paper: boolean;
  text: string;
}

/** Links of more characters may be cut off by mail and course systems. */
const LONG_LINK = 2000;
const NO_TEXT = "The scenario has changes that are refused or not written out: mend or undo them first.";

interface Line {
  words: string;
  title: string;
  value: string;
}

/** A button with a list of actions under it. */
function menu(label: string, lines: readonly Line[], onChoice: (value: string) => void): HTMLElement {
  const items = lines.map(({ words, title, value }) =>
    button({ class: "menu-line", title, set: { "data-value": value } }, () => {
      close();
      onChoice(value);
    }, words),
  );
  const list = el("details", { class: "tool-menu" }, el("summary", { class: "button text-button" }, label, icon("down")), el("div", { class: "menu" }, ...items));
  const close = (): void => {
    if (!list.open) return;
    list.open = false;
    list.querySelector("summary")?.focus();
  };
  list.addEventListener("keydown", (event) => {
    if (event.key === "Escape") close();
    // Keys of the page, such as those of its film, are not meant while a list is open.
    if (list.open) event.stopPropagation();
  });
  list.addEventListener("focusout", ({ relatedTarget }) => {
    if (relatedTarget instanceof Node && !list.contains(relatedTarget)) list.open = false;
  });
  document.addEventListener("pointerdown", ({ target }) => {
    if (target instanceof Node && !list.contains(target)) list.open = false;
  });
  return list;
}

export class Tools {
  readonly #channel: Channel;
  readonly #cell: PlaygroundCell;
  /** Address of a text. */
  readonly #link: (text: string) => Promise<string>;
  readonly elements: HTMLElement[];

  constructor(channel: Channel, cell: PlaygroundCell, shipped: readonly ShippedScenario[], link: (text: string) => Promise<string>) {
    this.#channel = channel;
    this.#cell = cell;
    this.#link = link;
    const file = el("input", { set: { type: "file", accept: ".toml,text/plain", hidden: "" } });
    file.addEventListener("change", () => {
      const [chosen] = file.files ?? [];
      file.value = "";
      if (chosen !== undefined) void this.#open(chosen);
    });
    const scenarios = shipped.map(({ name, about, is_paper }) => ({ value: name, words: is_paper ? `${name} (not planned here)` : name, title: about }));
    const files = Object.entries({ scenario: "Scenario (TOML)", ...FILES }).map(([value, words]) => ({ value, words, title: words }));
    this.elements = [
      menu("Scenario", scenarios, (name) => {
        const chosen = shipped.find((one) => one.name === name);
        if (chosen === undefined) return;
        cell.take(chosen.text, `Open ${name}`);
        cell.notice(`${name}: ${chosen.about}.`);
      }),
      button({ class: "button text-button", title: "Open a scenario’s file (TOML)" }, () => file.click(), "Open …"),
      file,
      menu("Download", files, (kind) => void this.download(kind)),
      button({ class: "button text-button", title: "Copy a link to this cell: whoever opens it sees this scenario" }, () => void this.#copy(), icon("copy"), "Link"),
      el("p", { class: "edit-notice playground-about" }, "Planned and proved in this browser alone: nothing you change here leaves it. Drag a plate, or choose a scenario."),
    ];
  }

  /** Downloads the scenario, or files of one of the `FILES`. */
  async download(kind: string): Promise<void> {
    const text = this.#cell.commit();
    if (text === null) return this.#cell.notice(`Nothing to download yet. ${NO_TEXT}`);
    if (kind === "scenario") return download({ name: scenarioFile(text), text });
    this.#cell.notice("Writing …");
    try {
      const files = await filesOf(this.#channel, text, kind as FileKind);
      for (const file of files) download(file);
      const many = files.length > 1 ? " The browser may ask whether this page may download several files." : "";
      this.#cell.notice(`Downloaded ${files.map(({ name }) => name).join(", ")}.${many}`);
    } catch (error) {
      this.#cell.notice(`Not written: ${error instanceof Error ? error.message : String(error)}`);
    }
  }

  async #open(file: File): Promise<void> {
    if (file.size > MOST_BYTES) return this.#cell.notice(`Not opened: ${file.name} is longer than 1 MiB, the most that platewash reads.`);
    try {
      const text = new TextDecoder("utf-8", { fatal: true }).decode(await file.arrayBuffer());
      this.#cell.take(text, `Open ${file.name}`);
    } catch (error) {
      const why = error instanceof TypeError ? "it is not a text in UTF-8" : String(error);
      this.#cell.notice(`Not opened: ${file.name}: ${why}.`);
    }
  }

  async #copy(): Promise<void> {
    const text = this.#cell.commit();
    if (text === null) return this.#cell.notice(`No link. ${NO_TEXT}`);
    const link = await this.#link(text);
    try {
      await navigator.clipboard.writeText(link);
      const long = ` It has ${link.length} characters: where that is too many, send the scenario’s file.`;
      this.#cell.notice(`Copied: whoever opens this link sees this cell.${link.length > LONG_LINK ? long : ""}`);
    } catch {
      this.#cell.notice("The browser lets this page copy nothing: the address of the page is the link.");
    }
  }
}

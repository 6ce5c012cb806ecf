/** Tools of the playground: scenarios to choose from, a file to open, files to take home, and a link to the cell. */
import type { PlaygroundCell } from "../edit/editor.ts";
import type { Channel } from "../edit/channel.ts";
import { button, el, icon } from "../shell/dom.ts";
import { download, FILES, type FileKind, filesOf, scenarioFile } from "./files.ts";

/** A scenario that comes with the program. */
export interface ShippedScenario {
  name: string;
  about: string;
  /** Whether it is the paper's program, which a live cell does not run. */
  is_paper: boolean;
  text: string;
}

/** Longest file that is opened [bytes]. */
const MOST_BYTES = 1 << 20;

/** A list whose first line says what it is for. */
function chooser(label: string, options: readonly (readonly [string, string, string])[], onChoice: (value: string) => void): HTMLSelectElement {
  const rows = options.map(([value, text, title]) => el("option", { title, set: { value } }, text));
  const list = el("select", { class: "button", set: { "aria-label": label } }, el("option", { set: { value: "", selected: "" } }, `${label} …`), ...rows);
  list.addEventListener("change", () => {
    const { value } = list;
    list.value = "";
    if (value !== "") onChoice(value);
  });
  return list;
}

export class Tools {
  readonly #channel: Channel;
  readonly #cell: PlaygroundCell;
  /** Writes the link to the cell into the address. */
  readonly #link: () => Promise<void>;
  readonly elements: HTMLElement[];

  constructor(channel: Channel, cell: PlaygroundCell, shipped: readonly ShippedScenario[], link: () => Promise<void>) {
    this.#channel = channel;
    this.#cell = cell;
    this.#link = link;
    const file = el("input", { set: { type: "file", accept: ".toml,text/plain", hidden: "" } });
    file.addEventListener("change", () => {
      const [chosen] = file.files ?? [];
      file.value = "";
      if (chosen !== undefined) void this.#open(chosen);
    });
    const scenarios = shipped.map(({ name, about, is_paper }) => [name, is_paper ? `${name} (not planned here)` : name, about] as const);
    const files = Object.entries(FILES).map(([kind, words]) => [kind, words, words] as const);
    this.elements = [
      chooser("Scenario", scenarios, (name) => {
        const chosen = shipped.find((one) => one.name === name);
        if (chosen === undefined) return;
        cell.take(chosen.text, `Open ${name}`);
        cell.notice(`${name}: ${chosen.about}.`);
      }),
      button({ class: "button text-button", title: "Open a scenario’s file (TOML)" }, () => file.click(), "Open …"),
      file,
      chooser("Download", [["scenario", "Scenario (TOML)", "Scenario (TOML)"], ...files], (kind) => void this.download(kind)),
      button({ class: "button text-button", title: "Copy a link to this cell: whoever opens it sees this scenario" }, () => void this.#copy(), icon("copy"), "Link"),
    ];
  }

  async #open(file: File): Promise<void> {
    if (file.size > MOST_BYTES) return this.#cell.notice(`Not opened: ${file.name} is longer than 1 MiB, the most that platewash reads.`);
    this.#cell.take(await file.text(), `Open ${file.name}`);
  }

  /** Downloads the scenario, or files of one of the `FILES`. */
  async download(kind: string): Promise<void> {
    const text = this.#cell.text();
    if (text === null) return this.#cell.notice("Nothing to download yet: the scenario has changes that are refused or not written out.");
    if (kind === "scenario") return download({ name: scenarioFile(this.#cell.name()), text });
    this.#cell.notice("Writing …");
    try {
      const files = await filesOf(this.#channel, text, kind as FileKind);
      for (const file of files) download(file);
      this.#cell.notice(`Downloaded ${files.map(({ name }) => name).join(", ")}.`);
    } catch (error) {
      this.#cell.notice(`Not written: ${error instanceof Error ? error.message : String(error)}`);
    }
  }

  async #copy(): Promise<void> {
    try {
      await this.#link();
      await navigator.clipboard.writeText(location.href);
      this.#cell.notice("Copied: whoever opens this link sees this cell.");
    } catch {
      this.#cell.notice("The address of this page is the link: copy it from there.");
    }
  }
}

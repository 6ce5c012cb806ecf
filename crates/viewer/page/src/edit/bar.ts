/** The bar that asks what is to become of a file that has changed. */
import { byId, button, el, isolated } from "../shell/dom.ts";
import { icon } from "../shell/icons.ts";
import type { Conflict, Disk } from "./disk.ts";

export class ConflictBar {
  readonly element = el("div", { class: "edit-bar notice tone-not_proved", set: { role: "alert" } });
  readonly #disk: () => Disk;
  #shown: Conflict | null = null;

  constructor(disk: () => Disk) {
    this.#disk = disk;
    this.element.hidden = true;
    byId("header").append(this.element);
  }

  show(conflict: Conflict | null): void {
    if (conflict === this.#shown) return;
    this.#shown = conflict;
    this.element.hidden = conflict === null;
    if (conflict === null) return;
    const take = button({ class: "button text-button" }, () => this.#disk().take(), "Take it");
    const keep = conflict.saving
      ? button({ class: "button text-button" }, () => void this.#disk().save(true), "Overwrite")
      : button({ class: "button text-button" }, () => this.#disk().keep(), "Keep mine");
    take.hidden = conflict.text === null;
    const close = button({ class: "button bare-button", label: "Decide later" }, () => this.#disk().keep(), icon("cross"));
    this.element.replaceChildren(icon("question"), el("p", {}, isolated(conflict.words)), take, keep, ...(conflict.saving ? [close] : []));
  }
}

/** Help over everything else. */
import { button, el } from "./dom.ts";
import { icon } from "./icons.ts";
import { keyTable } from "./keys.ts";

export class Help {
  readonly #dialog: HTMLDialogElement;

  constructor(film: boolean, more: readonly [string, string][] = []) {
    const close = button({ class: "button icon-button", label: "Close" }, () => this.#dialog.close(), icon("cross"));
    this.#dialog = el(
      "dialog",
      { class: "help", set: { "aria-labelledby": "help-title" } },
      el("header", {}, el("h2", { id: "help-title" }, "Keys and mouse"), close),
      keyTable(film, more),
      el("p", {}, "Drag the scene to turn it, with the right button or two fingers to move it, and scroll or pinch to come nearer."),
      el("p", {}, "Solid segments on the time line are washing. Signs above it show where a requirement is worst: click to go there."),
    );
    this.#dialog.addEventListener("click", (event) => {
      if (event.target === this.#dialog) this.#dialog.close();
    });
    document.body.append(this.#dialog);
  }

  toggle(): void {
    if (this.#dialog.open) this.#dialog.close();
    else this.#dialog.showModal();
  }

  button(): HTMLButtonElement {
    return button({ class: "button icon-button", label: "Help (?)" }, () => this.toggle(), "?");
  }
}

/** What keys do, and the help that says so over everything else. */
import { button, el, icon } from "./dom.ts";

/** What keys can ask for. */
export interface KeyActions {
  toggle(): void;
  /** Steps in time: 1 forth, −1 back. */
  step(direction: 1 | -1, coarse: boolean): void;
  toStart(): void;
  toEnd(): void;
  speed(up: boolean): void;
  /** To the plate with this number. */
  plate(number: string): void;
  layers(): void;
  camera(): void;
  picture(): void;
  fullscreen(): void;
  help(): void;
}

const FILM: [string, string][] = [
  ["Space", "play or pause"],
  ["← →", "one frame back or forth; with Shift a second"],
  ["Home End", "to the start, to the end"],
  ["[ ]", "slower, faster"],
  ["0 … 9", "to the washing of the plate with this number"],
];

const SCENE: [string, string][] = [
  ["C", "next view"],
  ["L", "layers"],
  ["P", "save a picture of the scene"],
  ["F", "full screen"],
  ["?", "this help"],
];

/** `more`: keys of a page that can do more than show. */
export function keyTable(film: boolean, more: readonly [string, string][] = []): HTMLElement {
  const rows = [...more, ...(film ? FILM : []), ...SCENE].map(([keys, words]) => {
    const caps = keys.split(" ").map((key) => (key === "…" ? key : el("kbd", {}, key)));
    return el("tr", {}, el("th", { set: { scope: "row" } }, ...caps), el("td", {}, words));
  });
  return el("table", { class: "keys" }, el("tbody", {}, ...rows));
}

/** Whether something leads to a moment, as a link does: Enter follows it, Space plays from there. */
function leads(target: EventTarget | null): boolean {
  return target instanceof Element && target.closest(".where-button, .mark") !== null;
}

/** Whether the key goes into a control that has a use of its own for it. */
function isTaken(event: KeyboardEvent): boolean {
  const target = event.target;
  if (!(target instanceof Element)) return false;
  if (target.closest("input, select, textarea, dialog, [contenteditable]") !== null) return true;
  return event.key === " " && target.closest("button, summary, a") !== null && !leads(target);
}

/** What a key asks for; undefined for nothing. */
function meant({ key, shiftKey }: KeyboardEvent, actions: KeyActions): (() => void) | undefined {
  if (/^[0-9]$/.test(key)) return () => actions.plate(key);
  const meanings: Record<string, () => void> = {
    " ": () => actions.toggle(),
    ArrowLeft: () => actions.step(-1, shiftKey),
    ArrowRight: () => actions.step(1, shiftKey),
    Home: () => actions.toStart(),
    End: () => actions.toEnd(),
    "[": () => actions.speed(false),
    "]": () => actions.speed(true),
    "?": () => actions.help(),
    l: () => actions.layers(),
    c: () => actions.camera(),
    p: () => actions.picture(),
    f: () => actions.fullscreen(),
  };
  return meanings[key.length === 1 ? key.toLowerCase() : key];
}

export function listenToKeys(actions: KeyActions): void {
  document.addEventListener("keydown", (event) => {
    if (event.defaultPrevented || event.ctrlKey || event.metaKey || event.altKey || isTaken(event)) return;
    const does = meant(event, actions);
    if (does === undefined) return;
    event.preventDefault();
    does();
  });
  document.addEventListener("keyup", (event) => {
    if (event.key === " " && leads(event.target)) event.preventDefault();
  });
}

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

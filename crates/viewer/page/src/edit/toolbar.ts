/** Undo, redo, save and what is going on; and the bar that asks what is to become of a file that has changed. */
import { button, byId, el, icon, isolated, TextCell } from "../shell/dom.ts";
import type { Activity } from "./answers.ts";
import type { Conflict, Disk } from "./disk.ts";

export interface ToolbarActions {
  undo(): void;
  redo(): void;
  save(): void;
}

export interface ToolbarShown {
  undoes: string | null;
  redoes: string | null;
  activity: Activity;
  /** Null where there is nothing to save to. */
  file: string | null;
  unsaved: boolean;
  saving: boolean;
  notice: string;
}

const WORDS: Record<Activity, string> = { idle: "", previewing: "looking …", planning: "planning …", proving: "proving …" };

export class Toolbar {
  readonly element: HTMLElement;
  readonly #undo: HTMLButtonElement;
  readonly #redo: HTMLButtonElement;
  readonly #save: HTMLButtonElement;
  readonly #saveWord = new TextCell("Save");
  readonly #activity = new TextCell();
  readonly #notice = new TextCell();

  /** `tools`: further ones beside undo, redo and save. */
  constructor(actions: ToolbarActions, tools: readonly HTMLElement[]) {
    this.#undo = button({ class: "button text-button" }, () => actions.undo(), icon("undo"), "Undo");
    this.#redo = button({ class: "button text-button" }, () => actions.redo(), icon("redo"), "Redo");
    this.#save = button({ class: "button text-button" }, () => actions.save(), this.#saveWord.node);
    this.element = el(
      "div",
      { class: "edit-tools", set: { role: "toolbar", "aria-label": "Scenario" } },
      this.#undo,
      this.#redo,
      this.#save,
      ...tools,
      el("span", { class: "edit-activity", set: { "aria-hidden": "true" } }, this.#activity.node),
      el("p", { class: "edit-notice", set: { role: "status" } }, el("bdi", {}, this.#notice.node)),
    );
  }

  show(shown: ToolbarShown): void {
    enable(this.#undo, shown.undoes !== null, shown.undoes === null ? "Nothing to undo" : `Undo: ${shown.undoes} (Ctrl+Z)`);
    enable(this.#redo, shown.redoes !== null, shown.redoes === null ? "Nothing to redo" : `Redo: ${shown.redoes} (Ctrl+Y)`);
    this.#save.hidden = shown.file === null;
    enable(this.#save, !shown.saving, `Save ${shown.file ?? ""} (Ctrl+S)`);
    this.#save.classList.toggle("unsaved", shown.unsaved);
    this.#saveWord.set(shown.saving ? "Saving …" : shown.unsaved ? "Save •" : "Saved");
    this.#activity.set(WORDS[shown.activity]);
    this.#notice.set(shown.notice);
  }
}

/** Not `disabled`, which would throw the focus away. */
function enable(of: HTMLButtonElement, on: boolean, title: string): void {
  const value = String(!on);
  if (of.getAttribute("aria-disabled") !== value) of.setAttribute("aria-disabled", value);
  if (of.title !== title) of.title = title;
}

/** Asks what is to become of a file that has changed. */
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

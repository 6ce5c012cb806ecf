/** The scene's place in the page: its canvas, its tools, a message where it cannot be drawn, and a still of it on paper. */
import type { Theme } from "../palette.ts";
import type { Follows } from "../player.ts";
import { PRESETS, Scene, SceneError, type Layer, type Room } from "../scene/index.ts";
import type { View } from "../view.ts";
import { announce, button, byId, el, icon } from "./dom.ts";

/**
 * Calls `prepare` before and after printing, and keeps a copy of the scene that it has drawn: the canvas's own content is gone once it
 * was shown.
 */
export function listenToPrint(canvas: HTMLCanvasElement, prepare: (printing: boolean) => void): void {
  const still = el("canvas", { class: "print-still", set: { "aria-hidden": "true" } });
  canvas.after(still);
  addEventListener("beforeprint", () => {
    prepare(true);
    still.width = canvas.width;
    still.height = canvas.height;
    if (canvas.width > 0 && canvas.height > 0) still.getContext("2d")?.drawImage(canvas, 0, 0);
  });
  addEventListener("afterprint", () => prepare(false));
}

/** Least share of the canvas's height that content is fitted into. */
const LEAST_ROOM = 0.4;

export interface StageActions {
  /** Something in the scene's look has changed. */
  changed(): void;
  heat(on: boolean): void;
  /** Null where nothing was carried out, so that there is nothing to choose. */
  follow: ((motion: Follows) => void) | null;
}

/** Whether the scene of two documents is the same: a proof changes nothing of it. */
function drawnAlike(a: View, b: View): boolean {
  const parts = ["arm", "tool", "surroundings", "plates", "paths", "segments", "motion", "clearance", "execution", "pose_rad"] as const;
  if (!parts.every((part) => a[part] === b[part]) || a.coverage.length !== b.coverage.length) return false;
  return a.coverage.every((one, k) => one.first === b.coverage[k]!.first && one.plate === b.coverage[k]!.plate);
}

function labelOf(view: View): string {
  return `The arm ${view.heading.robot} and ${view.plates.length} plates in three dimensions. Drag to turn, scroll to come nearer.`;
}

export class Stage {
  readonly scene: Scene | null;
  readonly root = byId("stage");
  readonly canvas: HTMLCanvasElement;
  readonly #actions: StageActions;
  #view: View;
  readonly #message = el("div", { class: "stage-message", set: { role: "alert" } });
  readonly #menu = el("div", { class: "menu", id: "layers-menu", set: { role: "group", "aria-label": "Layers" } });
  readonly #layersButton: HTMLButtonElement;
  readonly #camera = el("select", { class: "camera", set: { "aria-label": "View (C)" } });
  readonly #follow: HTMLSelectElement | null;
  readonly #heat: HTMLButtonElement;
  readonly #toolbarElement: HTMLElement;
  /** What lies over the scene's upper edge, one below the other. */
  readonly #over: HTMLElement;
  readonly #readout: HTMLElement | null;

  constructor(view: View, theme: Theme, banner: HTMLElement, readout: HTMLElement | null, actions: StageActions) {
    this.#actions = actions;
    this.#view = view;
    this.canvas = el("canvas", { class: "scene", set: { role: "img", "aria-label": labelOf(view) } });
    this.#layersButton = button(
      { class: "button text-button", title: "Layers (L)", set: { "aria-expanded": "false", "aria-controls": "layers-menu", "aria-label": "Layers" } },
      () => this.toggleLayers(),
      icon("layers"),
      el("span", { class: "wide-only" }, "Layers"),
    );
    this.#heat = button({ class: "button text-button", set: { "aria-pressed": "false" } }, () => {
      actions.heat(this.#heat.getAttribute("aria-pressed") !== "true");
    }, "Heat map");
    this.#menu.hidden = true;
    this.#message.hidden = true;
    this.#follow = actions.follow === null ? null : this.#followSelect(actions.follow, view);
    this.scene = this.#create(view, theme);
    this.#readout = readout;
    this.#toolbarElement = this.#toolbar(view);
    this.#over = el("div", { class: "over" }, el("div", { class: "over-bar" }, banner, this.#toolbarElement), this.#menu);
    const port = el("div", { class: "viewport" }, this.canvas, this.#message, this.#over);
    this.root.replaceChildren(port, ...(readout === null ? [] : [readout]));
    this.#fillMenu();
    this.#watch();
  }

  /** Shows another document. */
  replace(view: View): void {
    if (drawnAlike(view, this.#view)) return;
    this.#view = view;
    this.scene?.replace(view);
    this.#heat.hidden = view.coverage.length === 0;
    this.canvas.setAttribute("aria-label", labelOf(view));
    this.#actions.changed();
  }

  /** Fits the drawing to its place. */
  fit(): void {
    const { top, width, height } = this.canvas.getBoundingClientRect();
    if (width > 0 && height > 0) this.scene?.resize(width, height, Math.min(2, devicePixelRatio), this.#room(top, height));
    this.#actions.changed();
  }

  /** The part of the canvas that toolbar and readout leave free; all where little would be left. */
  #room(canvas_top: number, height: number): Room {
    const top = (this.#toolbarElement.getBoundingClientRect().bottom - canvas_top) / height;
    const below = this.#readout?.getBoundingClientRect();
    const bottom = below === undefined || below.height === 0 ? 1 : Math.min(1, (below.top - canvas_top) / height);
    return bottom - top > LEAST_ROOM ? { top, bottom } : { top: 0, bottom: 1 };
  }

  /** Puts something over the scene's upper edge. */
  cover(shown: HTMLElement): void {
    this.#over.append(shown);
  }

  /** Adds a tool, what it shows over the scene's upper edge, and what it shows anywhere on the scene. */
  addTool(tool: HTMLElement, shown: HTMLElement, ...anywhere: HTMLElement[]): void {
    this.#heat.before(tool);
    this.cover(shown);
    this.#over.after(...anywhere);
  }

  camera(preset: string): void {
    const known = PRESETS.find(({ id }) => id === preset);
    if (known === undefined || this.scene === null) return;
    this.scene.camera(known.id);
    this.#camera.value = known.id;
    this.#actions.changed();
  }

  nextCamera(): void {
    if (this.scene === null) return;
    const { id, label } = PRESETS[(this.#camera.selectedIndex + 1) % PRESETS.length]!;
    this.camera(id);
    announce(`View: ${label}`);
  }

  setLayer(layer: Layer, on: boolean): void {
    this.scene?.setLayer(layer, on);
    this.#fillMenu();
    this.#actions.changed();
  }

  toggleLayers(): void {
    this.#menu.hidden = !this.#menu.hidden;
    this.#layersButton.setAttribute("aria-expanded", String(!this.#menu.hidden));
    if (!this.#menu.hidden) this.#menu.querySelector("input")?.focus();
    else this.#layersButton.focus();
  }

  toggleFullscreen(): void {
    const done = document.fullscreenElement === null ? document.documentElement.requestFullscreen?.() : document.exitFullscreen();
    done?.catch(() => announce("The browser does not let this page fill the screen"));
  }

  /** Saves a picture of the scene at this moment as a PNG. */
  savePicture(): void {
    if (this.scene === null) return;
    el("a", { set: { href: this.scene.picture(2), download: "platewash.png" } }).click();
    announce("The picture is saved as platewash.png");
  }

  /** Which motion is shown, and whether plates show their heat map. */
  showMotion(follows: Follows, heat: boolean): void {
    if (this.#follow !== null) this.#follow.value = follows;
    this.#heat.setAttribute("aria-pressed", String(heat));
  }

  #create(view: View, theme: Theme): Scene | null {
    try {
      return new Scene(this.canvas, view, theme);
    } catch (error) {
      if (!(error instanceof SceneError)) throw error;
      this.#say(error.message);
      this.canvas.hidden = true;
      return null;
    }
  }

  #say(words: string | null): void {
    this.#message.hidden = words === null;
    this.#message.replaceChildren(words === null ? "" : el("p", {}, words, el("br"), "Everything else on this page works."));
  }

  #followSelect(follow: (motion: Follows) => void, view: View): HTMLSelectElement {
    const done = { simulated: "Simulated motion", recorded: "Recorded motion", live: "Live motion" }[view.execution?.source ?? "simulated"];
    const select = el(
      "select",
      { class: "follow", set: { "aria-label": "Motion that the arm shows" } },
      el("option", { set: { value: "planned" } }, "Planned motion"),
      el("option", { set: { value: "executed" } }, done),
    );
    select.addEventListener("change", () => follow(select.value === "executed" ? "executed" : "planned"));
    return select;
  }

  #toolbar(view: View): HTMLElement {
    this.#camera.append(...PRESETS.map(({ id, label }) => el("option", { set: { value: id } }, label)));
    this.#camera.addEventListener("change", () => this.camera(this.#camera.value));
    this.#heat.hidden = view.coverage.length === 0;
    const full = button({ class: "button icon-button", label: "Full screen (F)" }, () => this.toggleFullscreen(), icon("fullscreen"));
    const picture = button({ class: "button icon-button", label: "Picture (P)" }, () => this.savePicture(), icon("camera"));
    const tools = this.scene === null ? [this.#follow, full] : [this.#follow, this.#camera, this.#heat, this.#layersButton, picture, full];
    return el("div", { class: "toolbar", set: { role: "toolbar", "aria-label": "Scene" } }, ...tools);
  }

  #fillMenu(): void {
    const layers = this.scene?.layers() ?? [];
    this.#menu.replaceChildren(
      ...layers.map(({ id, label, on }) => {
        const box = el("input", { set: { type: "checkbox" } });
        box.checked = on;
        box.addEventListener("change", () => {
          this.scene?.setLayer(id, box.checked);
          this.#actions.changed();
        });
        return el("label", {}, box, label);
      }),
    );
  }

  #watch(): void {
    const observer = new ResizeObserver(() => this.fit());
    for (const element of [this.canvas, this.#readout]) if (element !== null) observer.observe(element);
    this.canvas.addEventListener("webglcontextlost", () => this.#say("The graphics processor has taken the scene away; it comes back by itself."));
    this.canvas.addEventListener("webglcontextrestored", () => {
      this.#say(null);
      this.#actions.changed();
    });
    document.addEventListener("pointerdown", (event) => {
      const inside = event.target instanceof Node && (this.#menu.contains(event.target) || this.#layersButton.contains(event.target));
      if (!this.#menu.hidden && !inside) this.#close();
    });
    this.#menu.addEventListener("keydown", (event) => {
      if (event.key !== "Escape") return;
      this.#close();
      this.#layersButton.focus();
    });
  }

  #close(): void {
    this.#menu.hidden = true;
    this.#layersButton.setAttribute("aria-expanded", "false");
  }
}

/** The workcell in three dimensions: all that is drawn of a document at a moment. */
import { type Group, Mesh, MeshBasicMaterial, PerspectiveCamera, Ray, Vector3 } from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import type { ClearanceNow } from "../curves.ts";
import { matrixOf } from "../motion.ts";
import type { Theme } from "../palette.ts";
import type { Plate, View } from "../view.ts";
import { Content, LABELS, type Layer, LAYERS } from "./content.ts";
import { type EditActions, Editing } from "./editing.ts";
import { Retired } from "./graph.ts";
import { Haste } from "./haste.ts";
import { type Palette, PALETTES } from "./palette.ts";
import type { CoverageKind } from "./plates.ts";
import { ClearanceLine } from "./proof.ts";
import { Mark } from "./signs.ts";
import { Stage, Studio } from "./stage.ts";
import { type Extent, type Preset, type Room, Views } from "./views.ts";

export type { Layer } from "./content.ts";
export { BesideCell } from "./beside.ts";
export { SceneError } from "./stage.ts";
export { SweptVolume } from "./swept.ts";
export { PRESETS, type Preset, type Room } from "./views.ts";

/** What can be in the picture beside the document's own content. */
export interface Part {
  root: Group;
  /** What the picture has to hold then. */
  extent?: Extent;
  setPalette(palette: Palette): void;
}

/** A moment. */
export interface Shown {
  t_s: number;
  /** Joints of the arm that is drawn [rad]. */
  q: Float64Array;
  /** Commanded joints where they are not those of `q` [rad]. */
  commanded: Float64Array | null;
  /** The plate that is being washed. */
  washing: number | null;
  clearance: ClearanceNow | null;
  /** Up to when coverage is shown [s]. */
  coverageTime: number;
  coverageKind: CoverageKind;
  /** The final heat map in place of the coverage that builds up. */
  heat: boolean;
}

/** Layers of the plan, but the arm. */
const OF_PLAN: ReadonlySet<Layer> = new Set(["coverage", "dirt", "paths", "transits", "executed", "clearance"]);
/** Below this distance the commanded tip is not shown beside the tip [m]. */
const APART_M = 0.0005;
/** While plates are dragged their shadows follow so much later at most [ms], and in haste. */
const SHADOWS_MS = 90;
const HASTY_SHADOWS_MS = 1000;

export class Scene {
  readonly #stage: Stage;
  readonly #camera = new PerspectiveCamera(30, 1, 0.01, 100);
  readonly #controls: OrbitControls;
  readonly #views: Views;
  readonly #content: Content;
  readonly #retired: Retired;
  readonly #clearance = new ClearanceLine();
  readonly #mark = new Mark();
  readonly #studio = new Studio();
  readonly #on = new Map<Layer, boolean>();
  readonly #tip = new Vector3();
  readonly #scratch = new Vector3();
  readonly #canvas: HTMLCanvasElement;
  readonly #quick = matchMedia("(prefers-reduced-motion: reduce)");
  #theme: Theme;
  #size = { width: 1, height: 1, dpr: 1 };
  #room: Room = { top: 0, bottom: 1 };
  #shown: Shown | null = null;
  #nearest: ClearanceNow | null = null;
  #editing: Editing | null = null;
  readonly #parts = new Set<Part>();
  /** Whether there is something new to draw, and whether it changes the shadows. */
  #dirty = true;
  #moved = true;
  /** When shadows were last drawn [ms]. */
  #shaded_ms = 0;
  readonly #haste: Haste;
  /** Whether the next frame is drawn in haste. */
  #hasty = false;
  #lost = false;
  #stale = false;

  /** The scene of a document; `SceneError` where there is no WebGL 2. */
  constructor(canvas: HTMLCanvasElement, view: View, theme: Theme) {
    this.#canvas = canvas;
    this.#theme = theme;
    this.#stage = new Stage(canvas);
    this.#haste = new Haste(this.#stage.software);
    this.#retired = new Retired(this.#stage.renderer);
    this.#camera.up.set(0, 0, 1);
    this.#controls = new OrbitControls(this.#camera, canvas);
    this.#controls.enableDamping = true;
    this.#controls.dampingFactor = 0.12;
    this.#controls.maxPolarAngle = 0.98 * Math.PI;
    this.#controls.minDistance = 0.05;
    this.#content = new Content(view, this.#studio, this.#retired);
    this.#views = new Views(this.#camera, this.#controls, this.#content.extent);
    this.#stage.graph.add(this.#content.root, this.#clearance.root, this.#mark.sprite);
    this.#reach();
    this.#watch();
    this.setTheme(theme);
    for (const layer of LAYERS) this.setLayer(layer, layer !== "bodies");
    this.#pose(view.pose_rad);
    this.#views.go("overview", true);
    this.#stage.prepare(this.#camera);
  }

  /** What the picture has to hold. */
  get #extent(): Extent {
    return [...this.#parts].find(({ extent }) => extent !== undefined)?.extent ?? this.#content.extent;
  }

  /** Lights all that there is, and lets the camera go as far as that needs. */
  #reach(): void {
    const { sphere } = this.#extent;
    this.#controls.maxDistance = 60 * Math.max(1, sphere.radius);
    this.#stage.light(sphere);
  }

  /**
   * Shows another document in place of this one. Layers, theme, camera, mark and moment stay, and so does what both documents say
   * alike; an arm is the same where it is the same object. Previews are over; what else was said of plates stays until it is said anew.
   */
  replace(view: View): void {
    const kept = this.#content.replace(view);
    this.#content.setPalette(PALETTES[this.#theme]);
    for (const layer of LAYERS) this.#switch(layer);
    if (!kept.extent) {
      this.#reach();
      this.#views.setExtent(this.#content.extent, this.#quick.matches);
    }
    if (this.#shown !== null) this.show(this.#shown);
    else this.#pose(view.pose_rad);
    this.#editing?.replaced();
    this.#dirty = this.#moved = true;
    this.#haste.hurry();
  }

  /** Takes a part out of the picture and puts another one in. */
  swap<P extends Part>(before: P | null, make: ((content: Content, studio: Studio, retired: Retired) => P) | null): P | null {
    if (before !== null && this.#parts.delete(before)) this.#retired.add(before.root);
    const part = make?.(this.#content, this.#studio, this.#retired) ?? null;
    if (part !== null) {
      part.setPalette(PALETTES[this.#theme]);
      this.#parts.add(part);
      this.#stage.graph.add(part.root);
    }
    this.#reach();
    this.#views.setExtent(this.#extent, this.#quick.matches);
    this.#dirty = this.#moved = true;
    return part;
  }

  /** Lets hands move plates, and tells `actions` of it. */
  edit(actions: EditActions): Editing {
    const surface = {
      canvas: this.#canvas,
      content: this.#content,
      studio: this.#studio,
      ray: (x: number, y: number): Ray => this.#ray(x, y),
      pixel_m: (place: Vector3): number => (2 * this.#halfHeight * this.#camera.position.distanceTo(place)) / this.#size.height,
      setCamera: (free: boolean): void => {
        this.#controls.enabled = free;
        this.#views.hold(!free);
      },
      changed: (bodies: boolean): void => {
        this.#dirty = true;
        this.#moved ||= bodies;
        this.#haste.hurry();
      },
    };
    const editing = new Editing(surface, actions);
    editing.setPalette(PALETTES[this.#theme]);
    this.#editing = editing;
    this.#stage.graph.add(editing.root);
    this.#stage.prepare(this.#camera);
    this.#dirty = this.#moved = true;
    return editing;
  }

  #watch(): void {
    this.#controls.addEventListener("change", () => {
      this.#dirty = true;
      if (!this.#views.placing) this.#haste.hurry();
    });
    // The graphics processor has taken the scene away; it comes back by itself.
    this.#canvas.addEventListener("webglcontextlost", (event) => {
      event.preventDefault();
      this.#lost = true;
    });
    this.#canvas.addEventListener("webglcontextrestored", () => {
      this.#lost = false;
      this.#dirty = this.#moved = true;
    });
  }

  #pose(q: ArrayLike<number>): void {
    const { arm, tool } = this.#content;
    arm.set(q);
    arm.root.updateMatrixWorld(true);
    tool.press();
    this.#tip.setFromMatrixPosition(tool.tip.matrixWorld);
    this.#views.follow(this.#tip);
    this.#dirty = this.#moved = true;
  }

  /** Moves everything to a moment; draws nothing. No allocation. */
  show(shown: Shown): void {
    this.#shown = shown;
    this.#haste.change();
    this.#pose(shown.q);
    this.#content.plates.show(shown.coverageTime, shown.coverageKind, shown.heat);
    this.#content.paths.show(shown.t_s);
    this.#nearest = shown.clearance;
    this.#clearance.show(this.#isOn("clearance") ? shown.clearance : null);
    this.#showCommanded(shown.commanded);
  }

  #showCommanded(q: ArrayLike<number> | null): void {
    const { root } = this.#content.commanded;
    root.visible = false;
    if (q === null || !this.#isOn("executed")) return;
    this.#content.kinematics.tip(q, root.matrix);
    root.matrixWorldNeedsUpdate = true;
    root.visible = this.#scratch.setFromMatrixPosition(root.matrix).distanceTo(this.#tip) > APART_M;
  }

  get #halfHeight(): number {
    return Math.tan((this.#camera.fov * Math.PI) / 360);
  }

  /** A picture of the moment as PNG in a data URL, drawn with so many pixels to one of the page. */
  picture(dpr: number): string {
    const { width, height, dpr: own } = this.#size;
    const draw = (): void => {
      this.#moved = true;
      this.render();
    };
    this.resize(width, height, dpr);
    draw();
    const url = this.#canvas.toDataURL("image/png");
    this.resize(width, height, own);
    draw();
    return url;
  }

  /** Draws what is shown: in full, but where `needsRender` has found that there is haste. */
  render(): void {
    const hasty = this.#hasty;
    this.#hasty = false;
    if (this.#lost) return;
    const [halfHeight, pixel] = [this.#halfHeight, (2 * this.#halfHeight) / this.#size.height];
    this.#clearance.face(this.#camera, this.#scratch, halfHeight / 0.268);
    this.#mark.setScale(pixel);
    this.#content.numbers.setScale(pixel);
    this.#editing?.face(this.#camera, this.#scratch, halfHeight / 0.268, pixel);
    const distance = this.#camera.position.distanceTo(this.#controls.target);
    this.#content.paths.setScale(this.#size.height / (2 * distance * halfHeight));
    this.#content.paths.setSeenThrough(!hasty);
    const now = performance.now();
    const shadows = this.#moved && this.#shadowsAt(now, hasty);
    this.#stage.draw(this.#camera, shadows, hasty);
    this.#retired.free();
    this.#haste.drawn(now, hasty);
    this.#dirty = false;
    if (!shadows) return;
    this.#moved = false;
    this.#shaded_ms = now;
  }

  /** Whether shadows that no longer fit are drawn anew. */
  #shadowsAt(now: number, hasty: boolean): boolean {
    if (hasty) return now - this.#shaded_ms >= HASTY_SHADOWS_MS;
    // Without a graphics processor a full frame may be the last for long.
    return this.#stage.software || this.#editing?.dragging !== true || now - this.#shaded_ms >= SHADOWS_MS;
  }

  /** Moves the camera on where it is on its way, and says whether there is anything new to draw. */
  needsRender(): boolean {
    const now = performance.now();
    if (this.#views.advance(now / 1000)) {
      this.#dirty = true;
      this.#haste.hurry();
    }
    const owed = this.#haste.owes(now, this.#editing?.dragging === true);
    const late = !this.#stage.software && this.#moved && now - this.#shaded_ms >= SHADOWS_MS;
    this.#hasty = this.#haste.hasty(now);
    return (this.#dirty || late || owed) && !this.#lost;
  }

  /** Fits the drawing to its canvas, CSS pixels and device pixels a CSS pixel; `room` is what nothing covers of it. */
  resize(width: number, height: number, dpr: number, room = this.#room): void {
    this.#size = { width: Math.max(1, width), height: Math.max(1, height), dpr };
    this.#room = room;
    this.#stage.resize(width, height, dpr);
    this.#views.resize(this.#size.width, this.#size.height, room);
    this.#dirty = true;
  }

  /** Draws nothing of the plan but the arm: something is changed that it does not have. */
  setStale(on: boolean): void {
    if (on === this.#stale) return;
    this.#stale = on;
    for (const layer of OF_PLAN) this.#switch(layer);
    if (this.#shown !== null) this.show(this.#shown);
    this.#dirty = true;
  }

  setTheme(theme: Theme): void {
    this.#theme = theme;
    for (const part of [this.#stage, this.#studio, this.#content, this.#clearance, this.#mark]) part.setPalette(PALETTES[theme]);
    this.#editing?.setPalette(PALETTES[theme]);
    for (const part of this.#parts) part.setPalette(PALETTES[theme]);
    this.#dirty = true;
  }

  #isOn(layer: Layer): boolean {
    return this.#on.get(layer) === true && !(this.#stale && OF_PLAN.has(layer));
  }

  setLayer(layer: Layer, on: boolean): void {
    this.#on.set(layer, on);
    this.#switch(layer);
    if (layer === "clearance") this.#clearance.show(this.#isOn(layer) ? this.#nearest : null);
    if (layer === "executed" && !on) this.#content.commanded.root.visible = false;
    this.#dirty = this.#moved = true;
    // The shadows of what is hidden go with it, in a hasty frame, too.
    this.#shaded_ms = -Infinity;
  }

  /** Draws the objects of a layer in one colour, without light, so that a test tells them from others in a picture. */
  setMarker(layer: Layer, colour: string): void {
    const material = new MeshBasicMaterial({ color: colour, toneMapped: false });
    for (const object of this.#content.objectsOf(layer)) {
      object.traverse((part) => {
        if (part instanceof Mesh) part.material = material;
      });
    }
    this.#dirty = true;
  }

  #switch(layer: Layer): void {
    const on = this.#isOn(layer);
    for (const object of this.#content.objectsOf(layer)) object.visible = on;
    if (layer === "bodies") this.#content.bodies.setVisible(on);
    if (layer === "dirt") this.#content.plates.dirt.setVisible(on);
    if (layer === "coverage") this.#content.plates.setCoverage(on);
  }

  layers(): { id: Layer; label: string; on: boolean }[] {
    return LAYERS.map((id) => ({ id, label: LABELS[id], on: this.#on.get(id) ?? false }));
  }

  /** Goes to a view; at once where asked, or where a reader wants no motion. */
  camera(preset: Preset, atOnce = this.#quick.matches): void {
    this.#views.go(preset, atOnce);
    this.#dirty = true;
  }

  /** Marks a place and, where asked, looks at it, or at a plate where there is none, from where the plate's face is seen; null takes the mark away. */
  focus(place_m: readonly [number, number, number] | null, looks = true, plate: Plate | null = null): void {
    const drawn = place_m !== null && place_m.every(Number.isFinite);
    this.#mark.show(drawn ? [...place_m] : null);
    const at = drawn ? place_m : plate?.pose.position_m;
    const normal = plate === null ? null : new Vector3(0, 0, 1).transformDirection(matrixOf(plate.pose));
    if (at !== undefined && looks) this.#views.look(new Vector3(...at), normal, this.#quick.matches);
    else if (!drawn) this.#views.lookAway(this.#quick.matches);
    this.#dirty = true;
  }

  /** Adds executed samples: times [s] and joint positions [rad], six a time. */
  appendExecuted(times: ArrayLike<number>, rows: ArrayLike<number>): void {
    this.#content.paths.append(times, rows);
    this.#dirty = true;
  }

  /** Where the tip is in the scene graph, world frame [m]. */
  tip(): [number, number, number] {
    const { tip } = this.#content.tool;
    tip.updateWorldMatrix(true, false);
    const place = this.#scratch.setFromMatrixPosition(tip.matrixWorld);
    return [place.x, place.y, place.z];
  }

  /** Where a place of the world is on the canvas, CSS pixels from its upper left corner; null behind the eye. */
  project(place_m: readonly [number, number, number]): [number, number] | null {
    this.#camera.updateMatrixWorld();
    const place = new Vector3(...place_m).project(this.#camera);
    if (!(Math.abs(place.z) <= 1)) return null;
    return [(0.5 + 0.5 * place.x) * this.#size.width, (0.5 - 0.5 * place.y) * this.#size.height];
  }

  /** The ray through a place on the canvas [CSS px]. */
  #ray(x: number, y: number): Ray {
    this.#camera.updateMatrixWorld();
    const eye = new Vector3().setFromMatrixPosition(this.#camera.matrixWorld);
    const through = new Vector3((2 * x) / this.#size.width - 1, 1 - (2 * y) / this.#size.height, 0.5).unproject(this.#camera);
    return new Ray(eye, through.sub(eye).normalize());
  }

}

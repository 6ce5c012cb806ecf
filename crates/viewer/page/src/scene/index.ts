/** The workcell in three dimensions: all that is drawn of a document at a moment. */
import { PerspectiveCamera, Vector3, type Object3D } from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import { decodeCoverage } from "../coverage.ts";
import { Kinematics } from "../kinematics.ts";
import type { Theme } from "../palette.ts";
import type { View } from "../view.ts";
import { ArmGraph } from "./arm.ts";
import { ClearanceLine, type Nearest } from "./clearance.ts";
import { extentOf, type Extent } from "./extent.ts";
import { Floor } from "./floor.ts";
import { CommandedTip, FrameAxes } from "./frame.ts";
import { LABELS, LAYERS, type Layer } from "./layers.ts";
import { Mark } from "./mark.ts";
import { Obstacles } from "./obstacles.ts";
import { PALETTES, type Palette } from "./palette.ts";
import { Paths } from "./paths.ts";
import { Plates, type CoverageKind } from "./plates.ts";
import { disposeTree } from "./pose.ts";
import { ProofBodies } from "./proof.ts";
import { Stage } from "./stage.ts";
import { Studio } from "./studio.ts";
import { ToolGraph } from "./tool.ts";
import { PRESETS, Views, type Preset } from "./views.ts";

export type { Layer } from "./layers.ts";
export { SceneError } from "./stage.ts";
export type { Preset } from "./views.ts";

/** A moment. */
export interface Shown {
  t_s: number;
  /** Joints of the arm that is drawn [rad]. */
  q: Float64Array;
  /** Commanded joints where they are not those of `q` [rad]. */
  commanded: Float64Array | null;
  /** The plate that is being washed. */
  washing: number | null;
  clearance: Nearest | null;
  /** Up to when coverage is shown [s]. */
  coverageTime: number;
  coverageKind: CoverageKind;
  /** The final heat map in place of the coverage that builds up. */
  heat: boolean;
}

/** Below this distance the commanded tip is not shown beside the tip [m]. */
const APART_M = 0.0005;

export class Scene {
  readonly #stage: Stage;
  readonly #camera = new PerspectiveCamera(30, 1, 0.01, 100);
  readonly #controls: OrbitControls;
  readonly #views: Views;
  readonly #extent: Extent;
  readonly #arm: ArmGraph;
  readonly #tool: ToolGraph;
  readonly #plates: Plates;
  readonly #paths: Paths;
  readonly #floor: Floor;
  readonly #clearance = new ClearanceLine();
  readonly #axes = new FrameAxes();
  readonly #commanded: CommandedTip;
  readonly #obstacles: Obstacles;
  readonly #bodies: ProofBodies;
  readonly #mark = new Mark();
  readonly #kinematics: Kinematics;
  readonly #commandedPose = new Float64Array(16);
  readonly #studio = new Studio();
  readonly #on = new Map<Layer, boolean>();
  readonly #tip = new Vector3();
  readonly #scratch = new Vector3();
  readonly #canvas: HTMLCanvasElement;
  readonly #quick = matchMedia("(prefers-reduced-motion: reduce)");
  #theme: Theme;
  #size = { width: 1, height: 1, dpr: 1 };
  #nearest: Nearest | null = null;
  /** Whether there is something new to draw, and whether it changes the shadows. */
  #dirty = true;
  #moved = true;
  #lost = false;

  /** Builds the scene of a document; `SceneError` where there is no WebGL 2. */
  static create(canvas: HTMLCanvasElement, view: View, theme: Theme): Scene {
    return new Scene(canvas, view, theme);
  }

  private constructor(canvas: HTMLCanvasElement, view: View, theme: Theme) {
    this.#canvas = canvas;
    this.#theme = theme;
    this.#stage = new Stage(canvas);
    this.#camera.up.set(0, 0, 1);
    this.#controls = new OrbitControls(this.#camera, canvas);
    this.#controls.enableDamping = true;
    this.#controls.dampingFactor = 0.12;
    this.#controls.maxPolarAngle = 0.98 * Math.PI;
    this.#obstacles = new Obstacles(view.surroundings.obstacles, this.#studio);
    this.#extent = extentOf(view, this.#obstacles.bounds());
    this.#controls.minDistance = 0.05;
    this.#controls.maxDistance = 60 * Math.max(1, this.#extent.sphere.radius);
    this.#views = new Views(this.#camera, this.#controls, this.#extent);
    this.#kinematics = new Kinematics(view.arm, view.tool);
    this.#arm = new ArmGraph(view.arm, this.#studio);
    this.#tool = new ToolGraph(view.tool, view.plates, this.#studio);
    this.#arm.flange.add(this.#tool.root);
    const executed = view.execution?.coverage ?? [];
    this.#plates = new Plates(view.plates, { planned: view.coverage.map(decodeCoverage), executed: executed.map(decodeCoverage) }, this.#studio);
    this.#paths = new Paths(view);
    this.#floor = new Floor(view.surroundings, view.arm.mount.position_m, this.#studio);
    this.#commanded = new CommandedTip(view.tool?.sponge.radius_m || 0.02);
    this.#bodies = new ProofBodies(view, this.#arm);
    this.#assemble();
    this.#watch();
    this.setTheme(theme);
    for (const layer of LAYERS) this.setLayer(layer, layer !== "bodies");
    this.#pose(view.pose_rad);
    this.#views.go("overview", true);
    this.#stage.prepare(this.#camera);
  }

  #assemble(): void {
    this.#tool.tip.add(this.#axes.root);
    this.#stage.graph.add(
      this.#floor.ground, this.#floor.region, this.#arm.root, this.#plates.root, this.#obstacles.root,
      this.#paths.wash, this.#paths.transits, this.#paths.executed, this.#clearance.root, this.#commanded.root, this.#mark.sprite,
    );
    const { center, radius } = this.#extent.sphere;
    this.#floor.setExtent(center, Math.max(2, 2.6 * radius));
    this.#stage.light(this.#extent.sphere);
  }

  #watch(): void {
    this.#controls.addEventListener("change", () => {
      this.#dirty = true;
    });
    this.#canvas.addEventListener("webglcontextlost", this.#onLost);
    this.#canvas.addEventListener("webglcontextrestored", this.#onRestored);
  }

  readonly #onLost = (event: Event): void => {
    event.preventDefault();
    this.#lost = true;
  };

  readonly #onRestored = (): void => {
    this.#lost = false;
    this.#dirty = this.#moved = true;
  };

  /** Whether the graphics processor has taken the scene away; it comes back by itself. */
  get lost(): boolean {
    return this.#lost;
  }

  #pose(q: ArrayLike<number>): void {
    this.#arm.set(q);
    this.#arm.root.updateMatrixWorld(true);
    this.#tool.press();
    this.#tip.setFromMatrixPosition(this.#tool.tip.matrixWorld);
    this.#views.follow(this.#tip);
    this.#dirty = this.#moved = true;
  }

  /** Moves everything to a moment; draws nothing. No allocation. */
  show(shown: Shown): void {
    this.#pose(shown.q);
    this.#plates.show(shown.coverageTime, shown.coverageKind, shown.heat);
    this.#paths.show(shown.t_s);
    this.#nearest = shown.clearance;
    this.#clearance.show(this.#isOn("clearance") ? shown.clearance : null);
    this.#showCommanded(shown.commanded);
  }

  #showCommanded(q: ArrayLike<number> | null): void {
    const root = this.#commanded.root;
    root.visible = false;
    if (q === null || !this.#isOn("executed")) return;
    root.matrix.fromArray(this.#kinematics.tip(q, this.#commandedPose));
    root.matrixWorldNeedsUpdate = true;
    root.visible = this.#scratch.setFromMatrixPosition(root.matrix).distanceTo(this.#tip) > APART_M;
  }

  /** Draws what is shown. */
  render(): void {
    if (this.#lost) return;
    const halfHeight = Math.tan((this.#camera.fov * Math.PI) / 360);
    this.#clearance.face(this.#camera, this.#scratch, halfHeight / 0.268);
    this.#mark.setScale((2 * halfHeight) / this.#size.height);
    const distance = this.#camera.position.distanceTo(this.#controls.target);
    this.#paths.setScale(this.#size.height / (2 * distance * halfHeight));
    this.#stage.draw(this.#camera, this.#moved);
    this.#dirty = this.#moved = false;
  }

  /** Moves the camera on where it is on its way, and says whether there is anything new to draw. */
  needsRender(): boolean {
    if (this.#views.advance(performance.now() / 1000)) this.#dirty = true;
    return this.#dirty && !this.#lost;
  }

  /** Fits the drawing to its canvas, CSS pixels and device pixels a CSS pixel. */
  resize(width: number, height: number, dpr: number): void {
    this.#size = { width: Math.max(1, width), height: Math.max(1, height), dpr };
    this.#stage.resize(width, height, dpr);
    this.#camera.aspect = this.#size.width / this.#size.height;
    this.#camera.updateProjectionMatrix();
    this.#views.refit();
    this.#dirty = true;
  }

  get theme(): Theme {
    return this.#theme;
  }

  setTheme(theme: Theme): void {
    this.#theme = theme;
    const palette: Palette = PALETTES[theme];
    const parts = [
      this.#stage, this.#studio, this.#floor, this.#plates, this.#paths, this.#tool, this.#clearance, this.#commanded, this.#obstacles,
      this.#bodies, this.#mark,
    ];
    for (const part of parts) part.setPalette(palette);
    this.#dirty = true;
  }

  #isOn(layer: Layer): boolean {
    return this.#on.get(layer) ?? false;
  }

  #objectsOf(layer: Layer): readonly Object3D[] {
    switch (layer) {
      case "arm": return [...this.#arm.visuals, ...this.#tool.visuals];
      case "plates": return [this.#plates.root];
      case "paths": return [this.#paths.wash];
      case "transits": return [this.#paths.transits];
      case "executed": return [this.#paths.executed];
      case "tip": return [this.#axes.root];
      case "region": return [this.#floor.region];
      case "obstacles": return [this.#obstacles.root];
      case "floor": return [this.#floor.ground];
      default: return [];
    }
  }

  setLayer(layer: Layer, on: boolean): void {
    this.#on.set(layer, on);
    for (const object of this.#objectsOf(layer)) object.visible = on;
    if (layer === "bodies") this.#bodies.setVisible(on);
    if (layer === "coverage") this.#plates.setCoverage(on);
    if (layer === "clearance") this.#clearance.show(on ? this.#nearest : null);
    if (layer === "executed" && !on) this.#commanded.root.visible = false;
    this.#dirty = this.#moved = true;
  }

  layers(): { id: Layer; label: string; on: boolean }[] {
    return LAYERS.map((id) => ({ id, label: LABELS[id], on: this.#isOn(id) }));
  }

  /** The views that there are. */
  cameras(): readonly { id: Preset; label: string }[] {
    return PRESETS;
  }

  get preset(): Preset {
    return this.#views.preset;
  }

  /** Goes to a view; at once where asked, or where a reader wants no motion. */
  camera(preset: Preset, atOnce = this.#quick.matches): void {
    this.#views.go(preset, atOnce);
    this.#dirty = true;
  }

  /** Marks a place and looks at it; null takes the mark away. */
  focus(place_m: readonly [number, number, number] | null): void {
    const drawn = place_m !== null && place_m.every(Number.isFinite);
    this.#mark.show(drawn ? [...place_m] : null);
    if (drawn) this.#views.look(new Vector3(...place_m), this.#quick.matches);
    this.#dirty = true;
  }

  /** Adds executed samples: times [s] and joint positions [rad], six a time. */
  appendExecuted(times: ArrayLike<number>, rows: ArrayLike<number>): void {
    this.#paths.append(times, rows);
    this.#dirty = true;
  }

  /** Where the tip is in the scene graph, world frame [m]. */
  tip(): [number, number, number] {
    this.#tool.tip.updateWorldMatrix(true, false);
    const place = this.#scratch.setFromMatrixPosition(this.#tool.tip.matrixWorld);
    return [place.x, place.y, place.z];
  }

  /** Where a place of the world is on the canvas, CSS pixels from its upper left corner; null behind the eye. */
  project(place_m: readonly [number, number, number]): [number, number] | null {
    this.#camera.updateMatrixWorld();
    const place = new Vector3(...place_m).project(this.#camera);
    if (!(Math.abs(place.z) <= 1)) return null;
    return [(0.5 + 0.5 * place.x) * this.#size.width, (0.5 - 0.5 * place.y) * this.#size.height];
  }

  /** A picture of the moment as PNG in a data URL, drawn at once; in another theme or size where asked. */
  still(options: { theme?: Theme; width?: number; height?: number; dpr?: number } = {}): string {
    const [theme, size] = [this.#theme, this.#size];
    const { width = size.width, height = size.height, dpr = size.dpr } = options;
    if (options.theme !== undefined) this.setTheme(options.theme);
    this.resize(width, height, dpr);
    this.#moved = true;
    this.render();
    const url = this.#canvas.toDataURL("image/png");
    if (options.theme !== undefined) this.setTheme(theme);
    this.resize(size.width, size.height, size.dpr);
    this.#moved = true;
    this.render();
    return url;
  }

  /** Frees what the graphics processor holds. */
  dispose(): void {
    this.#canvas.removeEventListener("webglcontextlost", this.#onLost);
    this.#canvas.removeEventListener("webglcontextrestored", this.#onRestored);
    this.#controls.dispose();
    disposeTree(this.#stage.graph);
    this.#plates.dispose();
    this.#bodies.dispose();
    this.#mark.dispose();
    this.#stage.dispose();
  }
}

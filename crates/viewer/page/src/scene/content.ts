/** All that is drawn of a document, and how another one takes its place: what says the same stays, the rest is made anew. */
import { Group, type Object3D, Vector3 } from "three";
import { decodeCoverage } from "../coverage.ts";
import { plateNumber } from "../format.ts";
import { Kinematics } from "../motion.ts";
import type { View } from "../view.ts";
import { ArmGraph, CommandedTip, FrameAxes } from "./arm.ts";
import { Floor, marksHeight } from "./floor.ts";
import type { Retired } from "./graph.ts";
import { Obstacles } from "./obstacles.ts";
import type { Palette } from "./palette.ts";
import { Paths } from "./paths.ts";
import { Plates } from "./plates.ts";
import { ProofBodies } from "./proof.ts";
import { PlateNumbers } from "./signs.ts";
import type { Studio } from "./stage.ts";
import { ToolGraph } from "./tool.ts";
import { type Extent, extentOf } from "./views.ts";

/** What can be shown or hidden. */
export type Layer =
  | "arm" | "bodies" | "plates" | "coverage" | "dirt" | "paths" | "transits" | "executed" | "tip" | "clearance" | "region" | "obstacles" | "floor";

/** Their names on the page, in its order. */
export const LABELS: Record<Layer, string> = {
  arm: "Arm and tool",
  plates: "Plates",
  coverage: "What is swept of the plates",
  dirt: "Dirt, until the dose is proved",
  paths: "Wash paths",
  transits: "Transits",
  executed: "Executed path",
  tip: "Tip frame",
  clearance: "Smallest clearance",
  region: "Region and base circle",
  obstacles: "Obstacles",
  floor: "Floor",
  bodies: "Bodies of the proof",
};

export const LAYERS = Object.keys(LABELS) as Layer[];

/** True for what is kept. */
export interface Kept {
  arm: boolean;
  tool: boolean;
  obstacles: boolean;
  /** The floor with base circle and region. */
  floor: boolean;
  /** Where plates lie and what they look like; coverage apart. */
  plates: boolean;
  planned: boolean;
  dirt: boolean;
  executed: boolean;
  /** All ways of the tip. */
  paths: boolean;
  /** What the camera has to show. */
  extent: boolean;
}

/** Whether two parts of documents say the same; whole arms and motions are not compared but by identity. */
function same(a: unknown, b: unknown): boolean {
  return a === b || JSON.stringify(a) === JSON.stringify(b);
}

/** Arrays made anew without anything in them are the same, too. */
function sameList(a: readonly unknown[], b: readonly unknown[]): boolean {
  return a === b || (a.length === 0 && b.length === 0);
}

/** Compares two documents; arms, motions, paths and coverage by identity, the rest by what it says. */
export function keptOf(before: View, after: View): Kept {
  const arm = before.arm === after.arm;
  const tool = same(before.tool, after.tool);
  const obstacles = same(before.surroundings.obstacles, after.surroundings.obstacles);
  const plates = same(before.plates, after.plates);
  const motion = before.motion === after.motion && (after.motion === null || sameList(before.segments, after.segments));
  const execution = before.execution === after.execution;
  return {
    arm,
    tool,
    obstacles,
    floor:
      same(before.arm.mount, after.arm.mount) &&
      before.surroundings.base_circle_m === after.surroundings.base_circle_m &&
      same(before.surroundings.polygon_m, after.surroundings.polygon_m) &&
      marksHeight(before) === marksHeight(after),
    plates,
    planned: sameList(before.coverage, after.coverage),
    dirt: sameList(before.dirt, after.dirt),
    executed: execution,
    paths: arm && tool && plates && motion && execution && sameList(before.paths, after.paths),
    extent: arm && tool && obstacles && plates && motion && same(before.pose_rad, after.pose_rad),
  };
}

const NOTHING: Kept = {
  arm: false, tool: false, obstacles: false, floor: false, plates: false, planned: false, dirt: false, executed: false, paths: false, extent: false,
};

export class Content {
  readonly root = new Group();
  readonly plates: Plates;
  readonly numbers = new PlateNumbers();
  readonly #axes = new FrameAxes();
  readonly #studio: Studio;
  readonly #retired: Retired;
  view: View;
  arm!: ArmGraph;
  tool!: ToolGraph;
  paths!: Paths;
  #floor!: Floor;
  obstacles!: Obstacles;
  bodies!: ProofBodies;
  commanded!: CommandedTip;
  kinematics!: Kinematics;
  extent!: Extent;

  constructor(view: View, studio: Studio, retired: Retired) {
    this.view = view;
    this.#studio = studio;
    this.#retired = retired;
    this.plates = new Plates(studio, retired);
    this.root.add(this.plates.root);
    this.#make(view, NOTHING);
  }

  /** Shows another document; what was kept. Palette and layers have to be set again. */
  replace(view: View): Kept {
    const kept = keptOf(this.view, view);
    this.view = view;
    this.#make(view, kept);
    return kept;
  }

  #make(view: View, kept: Kept): void {
    if (!kept.arm || !kept.tool) this.#makeArm(view, kept);
    if (!kept.obstacles) {
      this.#retire(this.obstacles?.root);
      this.obstacles = new Obstacles(view.surroundings.obstacles, this.#studio);
      this.root.add(this.obstacles.root);
    }
    if (!kept.plates) {
      this.plates.replace(view.plates);
      this.numbers.replace(this.plates.objects.map((one, k) => ({ ...one, number: plateNumber(view.plates, k) })), new Vector3(...view.arm.mount.position_m));
      this.tool.setPlates(view.plates);
    }
    if (!kept.planned) this.plates.cover("planned", view.coverage.map(decodeCoverage));
    if (!kept.plates || !kept.dirt) this.plates.lay(view.dirt);
    if (!kept.executed) this.plates.cover("executed", (view.execution?.coverage ?? []).map(decodeCoverage));
    if (!kept.paths) {
      this.#retire(this.paths?.wash, this.paths?.transits, this.paths?.executed);
      this.paths = new Paths(view);
      this.root.add(this.paths.wash, this.paths.transits, this.paths.executed);
    }
    if (!kept.floor) {
      this.#retire(this.#floor?.ground, this.#floor?.region);
      this.#floor = new Floor(view, this.#studio);
      this.root.add(this.#floor.ground, this.#floor.region);
    }
    if (!kept.extent) this.extent = extentOf(view, this.obstacles.bounds());
    const { center, radius } = this.extent.sphere;
    this.#floor.setExtent(center, Math.max(2, 2.6 * radius));
  }

  /** The arm is made anew only where it is another one, the tool where it, or the arm, is. */
  #makeArm(view: View, kept: Kept): void {
    this.#axes.root.removeFromParent();
    this.bodies?.retire(this.#retired);
    this.#retire(this.tool?.root, this.commanded?.root);
    if (!kept.arm) {
      this.#retire(this.arm?.root);
      this.arm = new ArmGraph(view.arm, this.#studio);
      this.root.add(this.arm.root);
    }
    this.tool = new ToolGraph(view.tool, view.plates, this.#studio);
    this.tool.tip.add(this.#axes.root);
    this.arm.flange.add(this.tool.root);
    this.bodies = new ProofBodies(view, this.arm);
    this.commanded = new CommandedTip(view.tool?.sponge.radius_m || 0.02);
    this.root.add(this.commanded.root);
    this.kinematics = new Kinematics(view.arm, view.tool);
  }

  #retire(...roots: (Object3D | undefined)[]): void {
    for (const root of roots) if (root !== undefined) this.#retired.add(root);
  }

  setPalette(palette: Palette): void {
    const parts = [this.#floor, this.plates, this.paths, this.tool, this.commanded, this.obstacles, this.bodies];
    for (const part of parts) part.setPalette(palette);
  }

  /** What a layer shows and hides as a whole. */
  objectsOf(layer: Layer): readonly Object3D[] {
    switch (layer) {
      case "arm": return [...this.arm.visuals, ...this.tool.visuals];
      case "plates": return [this.plates.root];
      case "paths": return [this.paths.wash];
      case "transits": return [this.paths.transits];
      case "executed": return [this.paths.executed];
      case "tip": return [this.#axes.root];
      case "region": return [this.#floor.region];
      case "obstacles": return [this.obstacles.root];
      case "floor": return [this.#floor.ground];
      default: return [];
    }
  }
}

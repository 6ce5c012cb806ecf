/** What of the scene is there only where it can be edited: what is selected, dragged and guessed, ghosts, ring and map. */
import { type Camera, Group, type Ray, Vector3 } from "three";
import type { Chance } from "../edit/protocol.ts";
import type { Content } from "./content.ts";
import { type GhostPlace, Ghosts } from "./ghost.ts";
import { type Centre, type Grab, Handles, middle, nearest, nearestAt, onPlane, type Phase, type Picked, type Solid } from "./handles.ts";
import { type MapPatch, WashMap } from "./map.ts";
import type { Palette } from "./palette.ts";
import { Outlines, partOf, RingHandle, ringThrough } from "./ring.ts";
import { Signs } from "./signs.ts";
import type { Studio } from "./stage.ts";
import { type Offending, Washability } from "./washability.ts";

export type Selection = number | "all" | null;

/** Who is told what hands do. */
export interface EditActions {
  /** A plate was pressed, or null for none. */
  select(plate: number | null): void;
  /** While the pointer moves and once when it is let go: where the centres of the grabbed plates are. */
  move(to: { plates: number[]; centres_m: Centre[] }, phase: Phase): void;
  /** The ghost of a plate was clicked. */
  take(plate: number): void;
  /** Whether plates may be moved; says why not, unless it is to be quiet. */
  mayMove(quiet?: boolean): boolean;
  /** A body that stands around was clicked; null for none. */
  selectBody(body: number | null): void;
  /** Where a body is on its way. */
  moveBody(body: number, centre_m: Centre, phase: Phase): void;
}

/** What editing needs of the scene. */
export interface Surface {
  readonly canvas: HTMLCanvasElement;
  readonly content: Content;
  readonly studio: Studio;
  /** The ray through a place on the canvas [CSS px]. */
  ray(x: number, y: number): Ray;
  /** How much of the world a CSS pixel is at a place [m]. */
  pixel_m(place: Vector3): number;
  setCamera(free: boolean): void;
  /** There is something new to draw; `bodies` where it changes the shadows. */
  changed(bodies: boolean): void;
}

/** What is near on the screen, to the ring [CSS px]: for a mouse, for a finger. */
const NEAR_PX = 8;
const NEAR_FINGER_PX = 18;
/** How far under the plates the map is, and at least over the floor [m]. */
const UNDER_M = 0.004;
const LEAST_M = 0.0025;
/** How far over the map the ring is [m]. */
const OVER_MAP_M = 0.0036;

export class Editing {
  readonly root = new Group();
  readonly #surface: Surface;
  readonly #actions: EditActions;
  readonly #handles: Handles;
  readonly #outlines = new Outlines();
  readonly #ring = new RingHandle();
  readonly #signs = new Signs();
  readonly #washability = new Washability();
  readonly #ghosts: Ghosts;
  readonly #map = new WashMap();
  #solids: Solid[] = [];
  #selection: Selection = null;
  #hovered: Picked | null = null;
  #preview: readonly Centre[] | null = null;
  /** Plates in the hand, which lie where it holds them whatever else is shown. */
  #carried = new Map<number, Centre>();
  #offending: readonly Offending[] = [];
  /** The body that is selected among those that stand around, and where one is shown elsewhere. */
  #body: number | null = null;
  #put: { body: number; centre_m: Centre } | null = null;
  #refused: readonly number[] = [];

  constructor(surface: Surface, actions: EditActions) {
    this.#surface = surface;
    this.#actions = actions;
    this.#ghosts = new Ghosts(surface.studio);
    this.root.add(
      this.#map.mesh, this.#washability.root, this.#outlines.root, this.#ring.root, this.#ghosts.root, this.#signs.root,
    );
    this.#handles = new Handles(surface.canvas, this);
    this.#arrange();
  }

  setPalette(palette: Palette): void {
    for (const part of [this.#outlines, this.#ring, this.#signs, this.#washability, this.#ghosts, this.#map]) part.setPalette(palette);
  }

  get dragging(): boolean {
    return this.#handles.dragging;
  }

  /** Another document is shown: previews are over, what is in the hand stays there. */
  replaced(): void {
    const { count } = this.#surface.content.plates;
    if ([...this.#carried.keys()].some((plate) => plate >= count)) this.#handles.cancel();
    if (typeof this.#selection === "number" && this.#selection >= count) this.#selection = null;
    if (this.#body !== null && this.#surface.content.obstacles.placeOf(this.#body) === null) this.#body = null;
    this.#surface.content.obstacles.select(this.#body);
    this.#surface.content.obstacles.refuse(this.#refused);
    this.#hovered = null;
    this.#preview = null;
    if (!this.dragging) this.#put = null;
    this.#lay();
    this.#washability.setOffending(this.#offending, this.#solids);
    this.#arrange();
  }

  select(selection: Selection): void {
    this.#selection = selection;
    this.#arrange();
  }

  preview(centres_m: readonly Centre[] | null): void {
    this.#preview = centres_m;
    this.#lay();
    this.#arrange();
  }

  selectBody(body: number | null): void {
    this.#body = body;
    this.#surface.content.obstacles.select(body);
    this.#surface.changed(false);
  }

  /** Draws bodies that stand around as refused, and no others. */
  refuse(bodies: readonly number[]): void {
    this.#refused = bodies;
    this.#surface.content.obstacles.refuse(bodies);
    this.#surface.changed(false);
  }

  previewBody(put: { body: number; centre_m: Centre } | null): void {
    if (this.#put !== null) this.#surface.content.obstacles.move(this.#put.body, null);
    this.#put = put;
    this.#lay();
  }

  chances(list: readonly { plate: number; chance: Chance }[]): void {
    this.#washability.setChances(list);
    this.#arrange();
  }

  offending(list: readonly Offending[]): void {
    this.#offending = list;
    this.#washability.setOffending(list, this.#solids);
    this.#arrange();
  }

  ghosts(list: readonly GhostPlace[]): void {
    this.#ghosts.set(list);
    this.#arrange();
  }

  map(patch: MapPatch | null): void {
    this.#map.add(patch);
    this.#surface.changed(false);
  }

  /** Lays the plates where they are held, previewed, or where the document has them. */
  #lay(): void {
    const { plates, paths, obstacles } = this.#surface.content;
    if (this.#put !== null) obstacles.move(this.#put.body, this.#put.centre_m);
    for (let plate = 0; plate < plates.count; plate++) plates.move(plate, this.#carried.get(plate) ?? this.#preview?.[plate] ?? null);
    paths.fade(plates.moved);
    this.#surface.changed(true);
  }

  /** Puts everything about the plates as they lie. */
  #arrange(): void {
    const { plates } = this.#surface.content;
    const shape = (plate: number): ReturnType<typeof plates.shape> => plates.shape(plate);
    this.#solids = plates.solids;
    const height = Math.max(LEAST_M, Math.min(1, ...this.#solids.map(({ pose, bottom_m }) => pose.elements[14]! + bottom_m)) - UNDER_M);
    this.#map.setHeight(height);
    this.#outlines.show("selected", this.#selected.map((plate) => this.#solids[plate]!));
    const over = this.#hovered?.kind === "plate" && !this.#selected.includes(this.#hovered.plate) ? [this.#solids[this.#hovered.plate]!] : [];
    this.#outlines.show("hovered", over);
    this.#ring.show(this.#ringNow(), height + OVER_MAP_M);
    this.#washability.show(this.#solids, shape);
    this.#signs.show(this.#solids.flatMap((solid, plate) => {
      const chance = this.#washability.chanceOf(plate);
      return chance === null || chance === "washable" ? [] : [{ kind: chance, solid }];
    }));
    this.#ghosts.show(this.#solids, shape);
    this.#surface.changed(false);
  }

  /** Plates that are selected. */
  get #selected(): number[] {
    if (this.#selection === "all") return this.#solids.map((_, plate) => plate);
    return this.#selection !== null && this.#solids[this.#selection] !== undefined ? [this.#selection] : [];
  }

  get #axis(): Centre {
    const [x, y] = this.#surface.content.view.arm.mount.position_m;
    return [x, y];
  }

  #ringNow(): ReturnType<typeof ringThrough> {
    const centres = this.#selected.map((plate) => centreOf(this.#solids[plate]!));
    if (centres.length === 0 || !this.#actions.mayMove(true)) return null;
    const rim = this.#solids[this.#selected[0]!]!.rim_m;
    return ringThrough(this.#axis, middle(centres), rim);
  }

  /** What a pointer is over. */
  pick(x: number, y: number, coarse: boolean): Picked | null {
    const ray = this.#surface.ray(x, y);
    const met = nearestAt(ray, this.#solids);
    const plate = met?.index ?? null;
    const ghost = this.#ghosts.plates[nearest(ray, this.#ghosts.solids) ?? -1];
    const ring = this.#overRing(ray, coarse);
    if (ring === "arrow") return { kind: "ring" };
    if (ghost !== undefined && (ghost !== plate || this.#nearGhost(ghost, x, y))) return { kind: "ghost", plate: ghost };
    const body = this.#surface.content.obstacles.nearest(ray);
    if (body !== null && body.along_m < (met?.along_m ?? Infinity)) return { kind: "body", body: body.index };
    if (plate !== null) return { kind: "plate", plate };
    return ring === null ? null : { kind: "ring" };
  }

  /** Where a ghost overlaps its own plate: whether its middle is nearer, or the plate's, which can still be dragged. */
  #nearGhost(plate: number, x: number, y: number): boolean {
    const [own, ghost] = [this.#solids[plate], this.#ghosts.solids[this.#ghosts.plates.indexOf(plate)]];
    if (own === undefined || ghost === undefined) return false;
    const place = this.toPlane(x, y, own.pose.elements[14]! + own.top_m);
    const away = (solid: Solid): number => Math.hypot(place![0] - centreOf(solid)[0], place![1] - centreOf(solid)[1]);
    return place !== null && away(ghost) < away(own);
  }

  #overRing(ray: Ray, coarse: boolean): ReturnType<typeof partOf> {
    const { ring, height_m } = this.#ring;
    const place = ring === null ? null : onPlane(ray, height_m);
    if (ring === null || place === null) return null;
    return partOf(ring, place, (coarse ? NEAR_FINGER_PX : NEAR_PX) * this.#surface.pixel_m(new Vector3(...place, height_m)));
  }

  /** Brings out what the pointer is over. */
  hover(picked: Picked | null): void {
    if (JSON.stringify(picked) === JSON.stringify(this.#hovered)) return;
    this.#hovered = picked;
    this.#ghosts.hover(picked?.kind === "ghost" ? picked.plate : null);
    this.#ring.setHeld(picked?.kind === "ring");
    this.#arrange();
  }

  /** What is held where something is pressed; null where that does not move. */
  grab(picked: Picked, x: number, y: number): { grab: Grab; height_m: number } | null {
    if (picked.kind === "ghost") return null;
    if (picked.kind === "body") return this.#grabBody(picked.body, x, y);
    const plates = picked.kind === "ring" || this.#selection === "all" ? this.#selected : [picked.plate];
    const [solid] = picked.kind === "ring" ? [] : [this.#solids[picked.plate]];
    const height_m = solid === undefined ? this.#ring.height_m : solid.pose.elements[14]! + solid.top_m;
    const from_m = this.toPlane(x, y, height_m);
    if (from_m === null || plates.length === 0) return null;
    const starts_m = plates.map((plate) => centreOf(this.#solids[plate]!));
    return { grab: { plates, starts_m, from_m, about_m: picked.kind === "ring" ? this.#axis : null }, height_m };
  }

  /** A body that is selected, in the plane through where it is held. */
  #grabBody(body: number, x: number, y: number): { grab: Grab; height_m: number } | null {
    const { obstacles } = this.#surface.content;
    const [ray, place] = [this.#surface.ray(x, y), obstacles.placeOf(body)];
    const met = obstacles.nearest(ray);
    if (body !== this.#body || place === null || met === null) return null;
    const height_m = ray.origin.z + met.along_m * ray.direction.z;
    const from_m = this.toPlane(x, y, height_m);
    if (from_m === null) return null;
    return { grab: { plates: [], body, starts_m: [[place[0], place[1]]], from_m, about_m: null }, height_m };
  }

  /** What is held begins to move; whether it may. */
  begin({ body }: Grab): boolean {
    return body !== undefined || this.#actions.mayMove();
  }

  /** Where a place on the canvas is in a level plane [m]; null where it is not in it. */
  toPlane(x: number, y: number, height_m: number): Centre | null {
    return onPlane(this.#surface.ray(x, y), height_m);
  }

  /** Moves the plates in the hand at once, and tells of it. Let go, they stay until another document is shown. */
  carry({ plates, body }: Grab, centres_m: readonly Centre[], phase: Phase): void {
    const [centre] = centres_m;
    if (body !== undefined && centre !== undefined) {
      this.previewBody({ body, centre_m: centre });
      this.#actions.moveBody(body, [centre[0], centre[1]], phase);
      return;
    }
    this.#carried = new Map(plates.map((plate, k) => [plate, centres_m[k]!]));
    if (phase === "end" || phase === "cancel") {
      this.#preview = this.#solids.map((solid, plate) => this.#carried.get(plate) ?? centreOf(solid));
      this.#carried.clear();
    }
    this.#lay();
    this.#arrange();
    this.#actions.move({ plates: [...plates], centres_m: centres_m.map(([x, y]) => [x, y]) }, phase);
  }

  /** Something was pressed: null for nothing. */
  press(picked: Picked | null): void {
    if (picked?.kind !== "plate" || this.#selection === "all") return;
    this.#choose(picked.plate);
  }

  /** It was pressed and let go without having been moved. */
  click(picked: Picked | null): void {
    if (picked === null || picked.kind !== "body") this.#actions.selectBody(null);
    if (picked?.kind === "body") this.#actions.selectBody(picked.body);
    else if (picked === null) this.#choose(null);
    else if (picked.kind === "ghost") this.#actions.take(picked.plate);
    else if (picked.kind === "plate" && this.#selection === "all") this.#choose(picked.plate);
  }

  #choose(plate: number | null): void {
    if (plate === null && this.#selection === null) return;
    this.select(plate);
    this.#actions.select(plate);
  }

  setCamera(free: boolean): void {
    this.#surface.setCamera(free);
  }

  /** Keeps what is of one size on the screen at that size. No allocation. */
  face(camera: Camera, eye: Vector3, narrow: number, pixel: number): void {
    this.#ring.face(camera, eye, narrow);
    this.#signs.setScale(pixel);
  }
}

function centreOf({ pose }: Solid): Centre {
  return [pose.elements[12]!, pose.elements[13]!];
}

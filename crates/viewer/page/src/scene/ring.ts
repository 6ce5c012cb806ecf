/** Circles about plates: outlines of those that are meant, and the ring by which they are turned about the arm's base axis. */
import { type Camera, ConeGeometry, Group, Matrix4, Mesh, MeshBasicMaterial, Vector3 } from "three";
import type { Centre, Solid } from "./handles.ts";
import { Lines, stretches } from "./lines.ts";
import type { Palette } from "./palette.ts";

export type OutlineKind = "selected" | "hovered";

/** How far outside the rim they are drawn [m]. */
const APART_M = 0.002;

/** A circle about the origin, `segments` chords. */
export function circle(radius_m: number, segments = 128): Float32Array {
  const places = Array.from({ length: segments + 1 }, (_, i) => {
    const angle = (2 * Math.PI * i) / segments;
    return [radius_m * Math.cos(angle), radius_m * Math.sin(angle), 0];
  });
  return stretches([places.flat()]);
}

/** Outlines about the rims of plates that are selected, and of the one that the pointer is over. */
export class Outlines {
  readonly root = new Group();
  readonly #pools: Record<OutlineKind, Lines[]> = { selected: [], hovered: [] };
  readonly #scale = new Matrix4();
  #palette: Palette | null = null;

  setPalette(palette: Palette): void {
    this.#palette = palette;
    for (const kind of ["selected", "hovered"] as const) for (const lines of this.#pools[kind]) lines.setColour(palette[kind]);
  }

  /** Draws outlines about these plates, and no others of their kind. */
  show(kind: OutlineKind, solids: readonly Solid[]): void {
    const pool = this.#pools[kind];
    while (pool.length < solids.length) pool.push(this.#make(kind));
    pool.forEach((lines, index) => {
      const solid = solids[index];
      lines.visible = solid !== undefined && solid.rim_m > 0;
      if (solid === undefined || !lines.visible) return;
      const size = solid.rim_m + APART_M;
      lines.matrix.copy(solid.pose).multiply(this.#scale.makeScale(size, size, 1).setPosition(0, 0, solid.top_m));
      lines.matrixWorldNeedsUpdate = true;
    });
  }

  #make(kind: OutlineKind): Lines {
    const style = kind === "selected" ? { width: 3.4, before: 4 } : { width: 2.4, opacity: 0.75, before: 4 };
    const lines = new Lines(circle(1), style);
    lines.matrixAutoUpdate = false;
    lines.renderOrder = 3;
    if (this.#palette !== null) lines.setColour(this.#palette[kind]);
    this.root.add(lines);
    return lines;
  }
}

/** Rings smaller than this cannot be turned by [m]. */
const LEAST_M = 0.04;
/** From the rim of a plate to the arrow [m]. */
const GAP_M = 0.035;
/** Farthest from the middle of what is turned to an arrow, along the ring [rad]. */
const WIDEST_RAD = 2.4;
/** Length of an arrow as share of its distance from the eye, where the angle of view is that of the overview. */
const ARROW = 0.016;

export interface Ring {
  axis_m: Centre;
  radius_m: number;
  /** Where what it turns is, as seen from the axis [rad]. */
  angle_rad: number;
  /** From there to either arrow [rad]. */
  arrow_rad: number;
}

/** The ring through a centre, for something of that radius about it; null where it would be too small. */
export function ringThrough(axis_m: Centre, centre_m: Centre, about_m: number): Ring | null {
  const [dx, dy] = [centre_m[0] - axis_m[0], centre_m[1] - axis_m[1]];
  const radius_m = Math.hypot(dx, dy);
  if (!(radius_m >= LEAST_M)) return null;
  return { axis_m, radius_m, angle_rad: Math.atan2(dy, dx), arrow_rad: Math.min(WIDEST_RAD, (about_m + GAP_M) / radius_m) };
}

/** Where the arrows of a ring are, seen from above [m]. */
export function arrowsOf({ axis_m, radius_m, angle_rad, arrow_rad }: Ring): [Centre, Centre] {
  const at = (angle: number): Centre => [axis_m[0] + radius_m * Math.cos(angle), axis_m[1] + radius_m * Math.sin(angle)];
  return [at(angle_rad - arrow_rad), at(angle_rad + arrow_rad)];
}

/** Whether a place in the ring's plane is on an arrow or on the line, `reach_m` being what is near on the screen; null where on neither. */
export function partOf(ring: Ring, place: Centre, reach_m: number): "arrow" | "line" | null {
  if (arrowsOf(ring).some(([x, y]) => Math.hypot(place[0] - x, place[1] - y) <= 2 * reach_m)) return "arrow";
  const off = Math.abs(Math.hypot(place[0] - ring.axis_m[0], place[1] - ring.axis_m[1]) - ring.radius_m);
  return off <= reach_m ? "line" : null;
}

/** The ring on the floor, with an arrow on either side of what it turns. */
export class RingHandle {
  readonly root = new Group();
  readonly #line = new Lines(circle(1), { width: 2.2, opacity: 0.7 });
  /** Arrows are before everything else, as plates that lie close together would hide them. */
  readonly #material = new MeshBasicMaterial({ toneMapped: false, transparent: true, depthTest: false });
  readonly #arrows: Mesh[];
  #ring: Ring | null = null;
  #height_m = 0;

  constructor() {
    const cone = new ConeGeometry(0.42, 1, 20).translate(0, 0.5, 0);
    this.#arrows = [new Mesh(cone, this.#material), new Mesh(cone, this.#material)];
    this.#line.renderOrder = 1;
    for (const arrow of this.#arrows) arrow.renderOrder = 7;
    this.root.add(this.#line, ...this.#arrows);
    this.root.visible = false;
  }

  get ring(): Ring | null {
    return this.#ring;
  }

  get height_m(): number {
    return this.#height_m;
  }

  setPalette(palette: Palette): void {
    this.#line.setColour(palette.turn);
    this.#material.color.set(palette.turn);
  }

  show(ring: Ring | null, height_m: number): void {
    this.#ring = ring;
    this.#height_m = height_m;
    this.root.visible = ring !== null;
    if (ring === null) return;
    this.#line.position.set(...ring.axis_m, height_m);
    this.#line.scale.set(ring.radius_m, ring.radius_m, 1);
    arrowsOf(ring).forEach(([x, y], index) => {
      const arrow = this.#arrows[index]!;
      const side = index === 0 ? -1 : 1;
      arrow.position.set(x, y, height_m + 0.004);
      // A cone points along y; along the ring that is its tangent, away from what is turned.
      arrow.rotation.z = ring.angle_rad + side * ring.arrow_rad + (side < 0 ? Math.PI : 0);
    });
  }

  /** Draws the ring as somebody has it in the hand, or not. */
  setHeld(held: boolean): void {
    this.#line.setWidth(held ? 4.5 : 2.2);
  }

  /** Keeps the arrows of one size on the screen. No allocation. */
  face(camera: Camera, eye: Vector3, narrow: number): void {
    eye.setFromMatrixPosition(camera.matrixWorld);
    for (const arrow of this.#arrows) arrow.scale.setScalar(ARROW * narrow * eye.distanceTo(arrow.position));
  }
}

/** Handles in the scene: rays from the eye, and pointers that press, drag and release plates, ghosts, bodies and the ring. */
import { Matrix4, Ray, Vector3 } from "three";
import type { Editing } from "./editing.ts";

/** Farthest hit of a ray that counts [m]. */
const FARTHEST_RAY_M = 25;
/** Rays flatter than this meet a level plane nowhere that can be aimed at. */
const FLATTEST = 0.02;

/** A plate as a ray meets it: a cylinder about its axis. */
export interface Solid {
  /** `T_world_plate` as drawn. */
  pose: Matrix4;
  rim_m: number;
  /** Heights in the plate's frame [m]. */
  top_m: number;
  bottom_m: number;
}

/** Where a ray meets the plane z = `height_m`; null where it does not, or too far off to be aimed at. */
export function onPlane(ray: Ray, height_m: number): [number, number] | null {
  const fall = ray.direction.z;
  if (!(Math.abs(fall) > FLATTEST) || !Number.isFinite(height_m)) return null;
  const along = (height_m - ray.origin.z) / fall;
  if (!(along >= 0 && along < FARTHEST_RAY_M)) return null;
  return [ray.origin.x + along * ray.direction.x, ray.origin.y + along * ray.direction.y];
}

/** How far along a ray a plate begins [m]; null where the ray misses it. The ray is in the plate's frame. */
function entry({ origin: o, direction: d }: Ray, solid: Solid): number | null {
  let [near, far] = [0, FARTHEST_RAY_M];
  const within = (from: number, to: number): void => {
    near = Math.max(near, Math.min(from, to));
    far = Math.min(far, Math.max(from, to));
  };
  if (Math.abs(d.z) > 1e-12) within((solid.bottom_m - o.z) / d.z, (solid.top_m - o.z) / d.z);
  else if (o.z < solid.bottom_m || o.z > solid.top_m) return null;
  const a = d.x * d.x + d.y * d.y;
  const b = o.x * d.x + o.y * d.y;
  const c = o.x * o.x + o.y * o.y - solid.rim_m * solid.rim_m;
  if (a > 1e-18) {
    const under = b * b - a * c;
    if (!(under >= 0)) return null;
    const root = Math.sqrt(under);
    within((-b - root) / a, (-b + root) / a);
  } else if (!(c <= 0)) return null;
  return near <= far ? near : null;
}

const inverse = new Matrix4();
const local = new Ray(new Vector3(), new Vector3());

/** The index of the solid that a ray meets first. */
export function nearest(ray: Ray, solids: readonly Solid[]): number | null {
  return nearestAt(ray, solids)?.index ?? null;
}

/** The same with how far along the ray that is [m]. */
export function nearestAt(ray: Ray, solids: readonly Solid[]): { index: number; along_m: number } | null {
  let [found, least]: [number | null, number] = [null, Infinity];
  solids.forEach((solid, index) => {
    const at = entry(local.copy(ray).applyMatrix4(inverse.copy(solid.pose).invert()), solid);
    if (at !== null && at < least) [found, least] = [index, at];
  });
  return found === null ? null : { index: found, along_m: least };
}

/** A plate's centre seen from above [m]. */
export type Centre = [number, number];

/** What the pointer does to the plates that it holds. */
export interface Grab {
  plates: number[];
  /** Their centres before. */
  starts_m: Centre[];
  /** Where the pointer took hold. */
  from_m: Centre;
  /** Null: they are shifted. Else they are turned about this place, the base axis. */
  about_m: Centre | null;
  /** In place of plates a body that stands around. */
  body?: number;
}

/** Steps of centres and of turns, and those of a hand that wants it finer. */
const STEP_M = 0.001;
const FINE_M = 0.0001;
const STEP_RAD = Math.PI / 360;
const FINE_RAD = Math.PI / 3600;
/** Plates are not carried farther than this from the world's origin [m]. */
const FARTHEST_M = 10;

/** `value` on a raster of so many steps a unit: a quotient, so that tenths of millimetres are the decimal numbers that they look like. */
export function stepped(value: number, per_unit: number): number {
  return Math.round(value * per_unit) / per_unit + 0;
}

/** The middle of centres; the origin of none. */
export function middle(centres: readonly Centre[]): Centre {
  const count = Math.max(1, centres.length);
  const sum = centres.reduce<Centre>((at, [x, y]) => [at[0] + x, at[1] + y], [0, 0]);
  return [sum[0] / count, sum[1] / count];
}

/** One plate's centre comes to lie on the raster; several keep how they lie to each other, so that their way does. */
function shifted({ starts_m, from_m }: Grab, to: Centre, fine: boolean): Centre[] {
  const per_m = Math.round(1 / (fine ? FINE_M : STEP_M));
  const way: Centre = [to[0] - from_m[0], to[1] - from_m[1]];
  if (starts_m.length === 1) return starts_m.map(([x, y]) => [stepped(x + way[0], per_m), stepped(y + way[1], per_m)]);
  const [dx, dy] = [stepped(way[0], per_m), stepped(way[1], per_m)];
  return starts_m.map(([x, y]) => [stepped(x + dx, 1e9), stepped(y + dy, 1e9)]);
}

/** By how much the pointer has turned about a place, on the raster [rad]. */
export function turnOf(about: Centre, from: Centre, to: Centre, fine: boolean): number {
  const angle = Math.atan2(to[1] - about[1], to[0] - about[0]) - Math.atan2(from[1] - about[1], from[0] - about[0]);
  const step = fine ? FINE_RAD : STEP_RAD;
  return Math.round(Math.atan2(Math.sin(angle), Math.cos(angle)) / step) * step;
}

function turned({ starts_m, from_m }: Grab, about: Centre, to: Centre, fine: boolean): Centre[] {
  const angle = turnOf(about, from_m, to, fine);
  return starts_m.map((centre) => (angle === 0 ? [...centre] : turnedAbout(centre, about, angle)));
}

/** A centre turned about an upright axis, counter-clockwise seen from above, to a tenth of a millimetre. */
export function turnedAbout([x, y]: Centre, axis: Centre, angle_rad: number): Centre {
  const [c, s, dx, dy] = [Math.cos(angle_rad), Math.sin(angle_rad), x - axis[0], y - axis[1]];
  const per_m = Math.round(1 / FINE_M);
  return [stepped(axis[0] + c * dx - s * dy, per_m), stepped(axis[1] + s * dx + c * dy, per_m)];
}

/** Where the plates' centres get to with the pointer at `to`; null where that is nowhere. */
export function carried(grab: Grab, to: Centre, fine: boolean): Centre[] | null {
  const centres = grab.about_m === null ? shifted(grab, to, fine) : turned(grab, grab.about_m, to, fine);
  return centres.every((centre) => centre.every((x) => Math.abs(x) <= FARTHEST_M)) ? centres : null;
}

/** What a pointer is over. */
export type Picked = { kind: "plate" | "ghost"; plate: number } | { kind: "ring" } | { kind: "body"; body: number };

/** How a drag goes on. */
export type Phase = "start" | "drag" | "end" | "cancel";

/** What is done with what hands do. Places on the canvas are CSS pixels from its upper left corner. */
type Touched = Pick<Editing, "pick" | "hover" | "grab" | "toPlane" | "begin" | "carry" | "press" | "click" | "setCamera">;

/** Way of a pointer up to which it has not moved [CSS px]. */
const STILL_PX = 4;

interface Held {
  pointer: number;
  picked: Picked | null;
  grab: Grab | null;
  height_m: number;
  at: [number, number];
  moved: boolean;
  centres_m: Centre[];
}

export class Handles {
  readonly #canvas: HTMLCanvasElement;
  readonly #touched: Touched;
  #held: Held | null = null;

  constructor(canvas: HTMLCanvasElement, touched: Touched) {
    this.#canvas = canvas;
    this.#touched = touched;
    // Before the camera's own, which is asked not to turn.
    canvas.addEventListener("pointerdown", this.#down, { capture: true });
    canvas.addEventListener("pointermove", this.#move, { capture: true });
    canvas.addEventListener("pointerup", this.#up, { capture: true });
    canvas.addEventListener("pointercancel", this.#lost, { capture: true });
    canvas.addEventListener("lostpointercapture", this.#lost, { capture: true });
    canvas.addEventListener("pointerleave", this.#leave);
    window.addEventListener("keydown", this.#key, { capture: true });
  }

  /** Whether plates are being dragged. */
  get dragging(): boolean {
    return this.#held?.grab !== null && this.#held?.moved === true;
  }

  #place(event: PointerEvent): [number, number] {
    const { left, top } = this.#canvas.getBoundingClientRect();
    return [event.clientX - left, event.clientY - top];
  }

  readonly #down = (event: PointerEvent): void => {
    if (this.#held !== null || !event.isPrimary || event.button !== 0) return;
    const at = this.#place(event);
    const picked = this.#touched.pick(...at, event.pointerType !== "mouse");
    const hold = picked === null ? null : this.#touched.grab(picked, ...at);
    this.#held = { pointer: event.pointerId, picked, grab: hold?.grab ?? null, height_m: hold?.height_m ?? 0, at, moved: false, centres_m: [] };
    // A body that is not selected lets the camera turn: it may be all that is in sight.
    if (picked === null || (picked.kind === "body" && hold === null)) return;
    this.#touched.setCamera(false);
    this.#canvas.setPointerCapture(event.pointerId);
    if (hold !== null) this.#canvas.style.cursor = "grabbing";
    this.#touched.press(picked);
  };

  readonly #move = (event: PointerEvent): void => {
    const held = this.#held;
    if (held === null) {
      if (event.isPrimary && event.buttons === 0) this.#hover(event);
      return;
    }
    if (event.pointerId !== held.pointer) return;
    const at = this.#place(event);
    if (!held.moved && Math.hypot(at[0] - held.at[0], at[1] - held.at[1]) < STILL_PX) return;
    if (!held.moved) this.#begin(held);
    this.#drag(held, at, event.altKey);
  };

  #begin(held: Held): void {
    held.moved = true;
    if (held.grab !== null && !this.#touched.begin(held.grab)) held.grab = null;
    if (held.grab === null) return;
    held.centres_m = held.grab.starts_m;
    this.#touched.carry(held.grab, held.centres_m, "start");
  }

  #drag(held: Held, at: [number, number], fine: boolean): void {
    if (held.grab === null) return;
    const place = this.#touched.toPlane(...at, held.height_m);
    const centres = place === null ? null : carried(held.grab, place, fine);
    if (centres === null || String(centres) === String(held.centres_m)) return;
    held.centres_m = centres;
    this.#touched.carry(held.grab, centres, "drag");
  }

  readonly #up = (event: PointerEvent): void => {
    const held = this.#held;
    if (held === null || event.pointerId !== held.pointer) return;
    if (held.moved) this.#drag(held, this.#place(event), event.altKey);
    this.#release();
    if (!held.moved) this.#touched.click(held.picked);
    else if (held.grab !== null) this.#touched.carry(held.grab, held.centres_m, "end");
    if (event.pointerType === "mouse") this.#hover(event);
  };

  readonly #lost = (event: PointerEvent): void => {
    if (event.pointerId === this.#held?.pointer) this.cancel();
  };

  readonly #leave = (): void => {
    if (this.#held === null) this.#touched.hover(null);
  };

  readonly #key = (event: KeyboardEvent): void => {
    if (event.key !== "Escape" || !this.dragging) return;
    event.preventDefault();
    event.stopImmediatePropagation();
    this.cancel();
  };

  /** Puts back what is dragged. */
  cancel(): void {
    const held = this.#held;
    if (held === null) return;
    this.#release();
    if (held.moved && held.grab !== null) this.#touched.carry(held.grab, held.grab.starts_m, "cancel");
  }

  #release(): void {
    const held = this.#held;
    this.#held = null;
    if (held === null || held.picked === null) return;
    if (this.#canvas.hasPointerCapture(held.pointer)) this.#canvas.releasePointerCapture(held.pointer);
    this.#canvas.style.cursor = "";
    this.#touched.setCamera(true);
  }

  #hover(event: PointerEvent): void {
    const picked = this.#touched.pick(...this.#place(event), event.pointerType !== "mouse");
    this.#touched.hover(picked);
    this.#canvas.style.cursor = picked === null ? "" : picked.kind === "ghost" || picked.kind === "body" ? "pointer" : "grab";
  }
}

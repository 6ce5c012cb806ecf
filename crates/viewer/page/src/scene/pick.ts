/** Rays from the eye: where they meet a level plane, and which plate they meet first. */
import { Matrix4, Ray, Vector3 } from "three";

/** Places farther from the eye are not meant [m]. */
const FARTHEST_M = 25;
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
  if (!(along >= 0 && along < FARTHEST_M)) return null;
  return [ray.origin.x + along * ray.direction.x, ray.origin.y + along * ray.direction.y];
}

/** How far along a ray a plate begins [m]; null where the ray misses it. The ray is in the plate's frame. */
function entry({ origin: o, direction: d }: Ray, solid: Solid): number | null {
  let [near, far] = [0, FARTHEST_M];
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

/** What the camera has to show: points of the arm, the plates and what stands around. */
import { Box3, Matrix4, Sphere, Vector3 } from "three";
import { Kinematics, matrixOf } from "../kinematics.ts";
import { floats } from "../numbers.ts";
import type { View } from "../view.ts";
import { PATCH_M, patchAt } from "./floor.ts";

/** How thick an arm is reckoned about the frames of its joints [m]. */
const THICK_M = 0.09;
const ABOVE = [new Vector3(0, 0, THICK_M)];
const AROUND = [...ABOVE, ...[[0, 0, -1], [1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0]].map((way) => new Vector3(...way).multiplyScalar(THICK_M))];
/** Places farther out are not shown [m]. */
const FARTHEST_M = 50;

export interface Extent {
  /** Places that have to be in the picture, world frame. */
  points: Vector3[];
  box: Box3;
  sphere: Sphere;
}

function platePoints(view: View): Vector3[] {
  return view.plates.flatMap((plate) => {
    const rim = plate.meridian_m[plate.meridian_m.length - 1] ?? [0, 0];
    const pose = matrixOf(plate.pose);
    return Array.from({ length: 8 }, (_, i) => {
      const angle = (i * Math.PI) / 4;
      return new Vector3(rim[0] * Math.cos(angle), rim[0] * Math.sin(angle), rim[1]).applyMatrix4(pose);
    });
  });
}

/** Where the arm gets to at up to 64 knots. */
function motionPoints(view: View): Vector3[] {
  const kinematics = new Kinematics(view.arm, view.tool);
  const rows = view.motion === null ? Float64Array.from(view.pose_rad) : floats(view.motion.q_rad);
  const axes = Math.max(1, view.arm.joints.length);
  const step = Math.max(1, Math.floor(rows.length / axes / 64));
  const pose = new Matrix4();
  const points: Vector3[] = [];
  // An arm that stands on the floor is seen from above; of others any side may be the outermost.
  const about = patchAt(view) === null ? AROUND : ABOVE;
  for (let k = 0; (k + 1) * axes <= rows.length; k += step) {
    kinematics.frames(rows, k * axes, (frame) => points.push(...about.map((way) => new Vector3().setFromMatrixPosition(frame).add(way))));
    points.push(new Vector3().setFromMatrixPosition(kinematics.tip(rows, pose, k * axes)));
  }
  return points;
}

/** The arm's foot, and the corners of the patch where it stands on one. */
function floorPoints(view: View): Vector3[] {
  const mount = matrixOf(view.arm.mount);
  const square = (half: number): Vector3[] => [-half, half].flatMap((x) => [-half, half].map((y) => new Vector3(x, y, 0).applyMatrix4(mount)));
  return [...square(0.2), ...(patchAt(view) === null ? [] : square(PATCH_M))];
}

/** Corners of a box of a size that can be shown. */
function corners(box: Box3): Vector3[] {
  if (box.isEmpty()) return [];
  const ends = [box.min, box.max];
  return ends.flatMap(({ x }) => ends.flatMap(({ y }) => ends.map(({ z }) => new Vector3(x, y, z))));
}

/** What a document's picture has to hold: arm, plates, and `obstacles` as a box. */
export function extentOf(view: View, obstacles: Box3): Extent {
  const drawable = (point: Vector3): boolean => point.toArray().every((x) => Number.isFinite(x) && Math.abs(x) < FARTHEST_M);
  const rims = platePoints(view).filter(drawable);
  const points = [...floorPoints(view), ...rims, ...motionPoints(view), ...corners(obstacles)].filter(drawable);
  const box = new Box3().setFromPoints(points);
  return { points, box, sphere: box.getBoundingSphere(new Sphere()) };
}

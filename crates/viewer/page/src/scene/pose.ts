/** Poses of the document in three's scene graph. */
import { Matrix4, Object3D } from "three";
import { matrixOf } from "../kinematics.ts";
import type { Pose } from "../view.ts";

export function matrix4(pose: Pose): Matrix4 {
  return new Matrix4().fromArray(matrixOf(pose));
}

/** Fixes an object to its parent at `T_parent_object`. */
export function fix<T extends Object3D>(object: T, pose: Pose): T {
  object.matrixAutoUpdate = false;
  object.matrix.copy(matrix4(pose));
  object.matrixWorldNeedsUpdate = true;
  return object;
}

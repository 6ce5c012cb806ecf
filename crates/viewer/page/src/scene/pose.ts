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

/** Frees geometries, materials and what else below `root` knows how to be freed. */
export function disposeTree(root: Object3D): void {
  root.traverse((object) => {
    const parts = object as { geometry?: { dispose(): void }; material?: { dispose(): void } | { dispose(): void }[] };
    parts.geometry?.dispose();
    for (const material of [parts.material ?? []].flat()) material.dispose();
  });
}

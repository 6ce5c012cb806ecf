/** Bodies that stand still. */
import { Box3, Color, DoubleSide, Group, Matrix4, Mesh, type MeshStandardMaterial, type Ray, Raycaster } from "three";
import { matrixOf } from "../motion.ts";
import type { Body } from "../view.ts";
import { fix } from "./graph.ts";
import type { Palette } from "./palette.ts";
import { geometryOf } from "./shapes.ts";
import type { Studio } from "./stage.ts";

/** Whether a body is the floor at z = 0, which is drawn as such. */
function isFloor(body: Body): boolean {
  const [, x, y] = body.pose.quaternion_wxyz;
  return body.shape === "half_space" && Math.abs(body.pose.position_m[2]) < 1e-6 && Math.hypot(x, y) < 1e-9;
}

/** The obstacles but the floor. */
export class Obstacles {
  readonly root = new Group();
  /** What is drawn of each body; nothing of the floor. */
  readonly #meshes: (Mesh | null)[];
  /** Where each body is. */
  readonly #poses: Matrix4[];
  readonly #caster = new Raycaster();
  readonly #held = new Color();
  #selected: number | null = null;
  #refused: readonly number[] = [];
  readonly #colours = { plain: new Color(), refused: new Color() };

  constructor(bodies: readonly Body[], studio: Studio) {
    this.#poses = bodies.map(({ pose }) => matrixOf(pose));
    this.#meshes = bodies.map((body) => {
      if (isFloor(body)) return null;
      const flat = body.shape === "half_space";
      const material = studio.material({ roughness: 0.7, ...(flat ? { transparent: true, opacity: 0.25, depthWrite: false, side: DoubleSide } : {}) });
      const mesh = fix(new Mesh(geometryOf(body.shape, "rounded"), material), body.pose);
      mesh.castShadow = !flat;
      mesh.receiveShadow = true;
      this.root.add(mesh);
      return mesh;
    });
  }

  /** The body with an end that a ray meets first, and how far along it [m]. */
  nearest(ray: Ray): { index: number; along_m: number } | null {
    if (!this.root.visible) return null;
    this.#caster.ray.copy(ray);
    const drawn = this.#meshes.filter((mesh): mesh is Mesh => mesh !== null && mesh.castShadow);
    const [hit] = this.#caster.intersectObjects(drawn, false);
    return hit === undefined ? null : { index: this.#meshes.indexOf(hit.object as Mesh), along_m: hit.distance };
  }

  /** Where a body is as drawn, world frame [m]; null where it is not drawn. */
  placeOf(body: number): [number, number, number] | null {
    const at = this.#meshes[body]?.matrix.elements;
    return at === undefined ? null : [at[12]!, at[13]!, at[14]!];
  }

  /** Draws a body elsewhere, seen from above [m]; null where it is. */
  move(body: number, centre_m: readonly [number, number] | null): void {
    const [mesh, pose] = [this.#meshes[body], this.#poses[body]];
    if (!mesh || pose === undefined) return;
    mesh.matrix.copy(pose);
    if (centre_m !== null) mesh.matrix.setPosition(centre_m[0], centre_m[1], pose.elements[14]!);
    mesh.matrixWorldNeedsUpdate = true;
  }

  /** Brings out a body. */
  select(body: number | null): void {
    this.#selected = body;
    this.#meshes.forEach((mesh, k) => {
      const material = mesh?.material as MeshStandardMaterial | undefined;
      material?.emissive.copy(k === body ? this.#held : new Color(0)).multiplyScalar(0.35);
    });
  }

  /** Draws bodies as refused, and no others. */
  refuse(bodies: readonly number[]): void {
    this.#refused = bodies;
    this.#meshes.forEach((mesh, k) => (mesh?.material as MeshStandardMaterial | undefined)?.color.copy(this.#colours[bodies.includes(k) ? "refused" : "plain"]));
  }

  /** A box about all obstacles with an end, empty without any. */
  bounds(): Box3 {
    const box = new Box3();
    for (const mesh of this.root.children) if (mesh.castShadow) box.expandByObject(mesh);
    return box;
  }

  setPalette(palette: Palette): void {
    this.#colours.plain.set(palette.obstacle);
    this.#colours.refused.set(palette.sign.unwashable);
    this.refuse(this.#refused);
    this.#held.set(palette.selected);
    this.select(this.#selected);
  }
}

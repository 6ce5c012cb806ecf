/** Bodies that stand still. */
import { Box3, DoubleSide, Group, Mesh } from "three";
import type { Body } from "../view.ts";
import { geometryOf } from "./bodies.ts";
import type { Palette } from "./palette.ts";
import { fix } from "./pose.ts";
import type { Studio } from "./studio.ts";

/** Whether a body is the floor at z = 0, which is drawn as such. */
function isFloor(body: Body): boolean {
  const [, x, y] = body.pose.quaternion_wxyz;
  return "half_space" in body.shape && Math.abs(body.pose.position_m[2]) < 1e-6 && Math.hypot(x, y) < 1e-9;
}

/** The obstacles but the floor. */
export class Obstacles {
  readonly root = new Group();
  readonly #plain: { color: { set(colour: string): void } }[] = [];

  constructor(bodies: readonly Body[], studio: Studio) {
    for (const body of bodies.filter((body) => !isFloor(body))) {
      const flat = "half_space" in body.shape;
      const alpha = flat ? 0.25 : (body.rgba?.[3] ?? 1);
      const material = studio.material({ roughness: 0.7, transparent: alpha < 1, opacity: alpha, depthWrite: alpha >= 1, ...(flat ? { side: DoubleSide } : {}) });
      if (body.rgba === null) this.#plain.push(material);
      else material.color.setRGB(body.rgba[0], body.rgba[1], body.rgba[2], "srgb");
      const mesh = fix(new Mesh(geometryOf(body.shape, "rounded"), material), body.pose);
      mesh.castShadow = !flat;
      mesh.receiveShadow = true;
      this.root.add(mesh);
    }
  }

  /** A box about all obstacles with an end, empty without any. */
  bounds(): Box3 {
    const box = new Box3();
    for (const mesh of this.root.children) if (mesh.castShadow) box.expandByObject(mesh);
    return box;
  }

  setPalette(palette: Palette): void {
    for (const material of this.#plain) material.color.set(palette.obstacle);
  }
}

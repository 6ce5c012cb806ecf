/** The volume that arm and tool sweep: the bodies of the proof at many moments, until the one that is shown. To look at: the proof is of every moment. */
import { Group, InstancedMesh, Matrix4, MeshBasicMaterial, MeshLambertMaterial } from "three";
import { AXES, Kinematics, matrixOf } from "../motion.ts";
import type { View } from "../view.ts";
import type { Palette } from "./palette.ts";
import { geometryOf } from "./shapes.ts";

export class SweptVolume {
  readonly root = new Group();
  /** Only what is in front is drawn, once: the depths come first. */
  readonly #depth = new MeshBasicMaterial({ colorWrite: false, transparent: true });
  readonly #colour = new MeshLambertMaterial({ transparent: true, opacity: 0.3, depthWrite: false });
  readonly #meshes: InstancedMesh[];
  readonly #moments: number;

  /** `rows`: joints at moments evenly apart [rad], six a row. */
  constructor({ arm, tool }: View, rows: Float64Array) {
    this.#moments = rows.length / AXES;
    const held = { joints: arm.joints.length, pose: arm.flange, collision: tool?.bodies ?? [] };
    const moving = [...arm.links.filter(({ joints }) => joints > 0), held];
    const bodies = moving.flatMap(({ joints, pose, collision }) => collision.map((body) => ({ joints, at: matrixOf(pose).multiply(matrixOf(body.pose)), meshes: this.#meshesOf(geometryOf(body.shape, "coarse")) })));
    this.#meshes = bodies.flatMap(({ meshes }) => meshes);
    const [kinematics, placed] = [new Kinematics(arm, null), new Matrix4()];
    for (let k = 0; k < this.#moments; k++) {
      let joint = 0;
      kinematics.frames(rows, k * AXES, (frame) => {
        joint++;
        for (const { joints, at, meshes } of bodies) if (joints === joint) for (const mesh of meshes) mesh.setMatrixAt(k, placed.multiplyMatrices(frame, at));
      });
    }
    this.root.add(...this.#meshes);
    this.until(0);
  }

  #meshesOf(geometry: ReturnType<typeof geometryOf>): InstancedMesh[] {
    return [this.#depth, this.#colour].map((material, k) => {
      const mesh = new InstancedMesh(geometry, material, this.#moments);
      mesh.frustumCulled = false;
      mesh.renderOrder = 20 + k;
      return mesh;
    });
  }

  setPalette(palette: Palette): void {
    this.#colour.color.set(palette.body);
  }

  /** Draws what is swept until this share of the motion. */
  until(share: number): void {
    for (const mesh of this.#meshes) mesh.count = Math.max(1, Math.ceil(this.#moments * Math.min(1, share)));
  }
}

/** The volume that arm and tool sweep: the bodies of the proof at many moments, until the one that is shown. To look at: the proof is of every moment. */
import { Group, InstancedMesh, Matrix4, MeshBasicMaterial, MeshLambertMaterial } from "three";
import { AXES, Kinematics, matrixOf } from "../motion.ts";
import type { Body, View } from "../view.ts";
import type { Palette } from "./palette.ts";
import { geometryOf } from "./shapes.ts";

/** Bodies with the joints that move them, in the frame behind these. */
function movingBodies({ arm, tool }: View): { joints: number; body: Body; at: Matrix4 }[] {
  const links = arm.links.filter(({ joints }) => joints > 0);
  const all = links.flatMap(({ joints, pose, collision }) => collision.map((body) => ({ joints, body, at: matrixOf(pose).multiply(matrixOf(body.pose)) })));
  const held = (tool?.bodies ?? []).map((body) => ({ joints: arm.joints.length, body, at: matrixOf(arm.flange).multiply(matrixOf(body.pose)) }));
  return [...all, ...held];
}

export class SweptVolume {
  readonly root = new Group();
  /** Only what is in front is drawn, once: the depths come first. */
  readonly #depth = new MeshBasicMaterial({ colorWrite: false, transparent: true });
  readonly #colour = new MeshLambertMaterial({ transparent: true, opacity: 0.3, depthWrite: false });
  readonly #meshes: InstancedMesh[] = [];
  readonly #moments: number;

  /** `rows`: joints at moments evenly apart [rad], six a row. */
  constructor(view: View, rows: Float64Array) {
    this.#moments = rows.length / AXES;
    const bodies = movingBodies(view).map((one) => {
      const geometry = geometryOf(one.body.shape, "coarse");
      const meshes = [this.#depth, this.#colour].map((material) => new InstancedMesh(geometry, material, this.#moments));
      meshes.forEach((mesh, k) => {
        mesh.frustumCulled = false;
        mesh.renderOrder = 20 + k;
      });
      return { ...one, meshes };
    });
    const kinematics = new Kinematics(view.arm, null);
    const placed = new Matrix4();
    for (let k = 0; k < this.#moments; k++) {
      let joints = 0;
      kinematics.frames(rows, k * AXES, (frame) => {
        joints++;
        for (const one of bodies) if (one.joints === joints) for (const mesh of one.meshes) mesh.setMatrixAt(k, placed.multiplyMatrices(frame, one.at));
      });
    }
    this.#meshes = bodies.flatMap(({ meshes }) => meshes);
    if (this.#meshes.length > 0) this.root.add(...this.#meshes);
    this.until(0);
  }

  setPalette(palette: Palette): void {
    this.#colour.color.set(palette.body);
  }

  /** Draws what is swept until this share of the motion. */
  until(share: number): void {
    for (const mesh of this.#meshes) mesh.count = Math.max(1, Math.ceil(this.#moments * Math.min(1, share)));
  }
}

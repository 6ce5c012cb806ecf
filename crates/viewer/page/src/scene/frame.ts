/** Axes of a frame, 0.05 m long as in the paper: x red, y green, z blue, faint where something hides them. */
import { BufferGeometry, Color, ConeGeometry, CylinderGeometry, GreaterDepth, Group, Mesh, MeshBasicMaterial, RingGeometry } from "three";
import { mergeGeometries } from "three/examples/jsm/utils/BufferGeometryUtils.js";
import type { Palette } from "./palette.ts";
import { colouredBy } from "./shapes.ts";

/** [m] */
const AXIS_M = 0.05;
const THICKNESS_M = 0.0011;
const AXES = ["#e0402f", "#2e9d46", "#2f6fe0"] as const;

/** One axis along y, then turned where it belongs. */
function arrow(index: number): BufferGeometry {
  const shaft = new CylinderGeometry(THICKNESS_M, THICKNESS_M, 0.82 * AXIS_M, 12).translate(0, 0.41 * AXIS_M, 0);
  const head = new ConeGeometry(2.8 * THICKNESS_M, 0.18 * AXIS_M, 16).translate(0, 0.91 * AXIS_M, 0);
  const geometry = mergeGeometries([shaft, head]);
  if (index === 0) geometry.rotateZ(-Math.PI / 2);
  if (index === 2) geometry.rotateX(Math.PI / 2);
  return colouredBy(new Color(AXES[index]), geometry);
}

export class FrameAxes {
  readonly root = new Group();

  constructor() {
    const geometry = mergeGeometries([arrow(0), arrow(1), arrow(2)]);
    const near = new Mesh(geometry, new MeshBasicMaterial({ vertexColors: true, toneMapped: false }));
    const hidden = new Mesh(
      geometry,
      new MeshBasicMaterial({ vertexColors: true, toneMapped: false, transparent: true, opacity: 0.4, depthFunc: GreaterDepth, depthWrite: false }),
    );
    near.renderOrder = 5;
    hidden.renderOrder = 4;
    this.root.add(near, hidden);
  }
}

/** Where the tip should be: a ring about the commanded place. */
export class CommandedTip {
  readonly root = new Group();
  readonly #material = new MeshBasicMaterial({ toneMapped: false, transparent: true, opacity: 0.85, side: 2, depthTest: false });

  constructor(radius_m: number) {
    const ring = new Mesh(new RingGeometry(radius_m * 1.12, radius_m * 1.12 + 0.0022, 64), this.#material);
    ring.renderOrder = 5;
    this.root.matrixAutoUpdate = false;
    this.root.add(ring);
    this.root.visible = false;
  }

  setPalette(palette: Palette): void {
    this.#material.color.set(palette.commanded);
  }
}

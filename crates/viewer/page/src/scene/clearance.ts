/** The smallest clearance at a moment: a line from body to body with a dot at either end; under the margin red and wider. */
import { GreaterDepth, Group, Mesh, MeshBasicMaterial, SphereGeometry, type Camera, type Vector3 } from "three";
import type { ClearanceNow } from "../clearances.ts";
import { Lines } from "./lines.ts";
import type { Palette } from "./palette.ts";

/** Radius of a dot as share of its distance from the eye. */
const DOT = 0.003;

export class ClearanceLine {
  readonly root = new Group();
  readonly #line = new Lines(new Float32Array(6).fill(1), { width: 3 });
  readonly #hidden = new Lines(new Float32Array(6).fill(1), { width: 2, opacity: 0.45, depth: GreaterDepth });
  readonly #material = new MeshBasicMaterial({ toneMapped: false, depthTest: false, transparent: true });
  readonly #dots: Mesh[];
  #palette: Palette | null = null;
  #near = false;

  constructor() {
    const sphere = new SphereGeometry(1, 16, 12);
    this.#dots = [new Mesh(sphere, this.#material), new Mesh(sphere, this.#material)];
    for (const line of [this.#line, this.#hidden]) line.frustumCulled = false;
    this.#line.renderOrder = 6;
    this.#hidden.renderOrder = 5;
    for (const dot of this.#dots) dot.renderOrder = 7;
    this.root.add(this.#hidden, this.#line, ...this.#dots);
    this.root.visible = false;
  }

  setPalette(palette: Palette): void {
    this.#palette = palette;
    this.#paint();
  }

  #paint(): void {
    if (this.#palette === null) return;
    const colour = this.#near ? this.#palette.tooNear : this.#palette.clearance;
    this.#line.setColour(colour);
    this.#hidden.setColour(colour);
    this.#material.color.set(colour);
    this.#line.style.linewidth = this.#near ? 5 : 2.6;
  }

  /** No allocation. */
  show(nearest: ClearanceNow | null): void {
    this.root.visible = nearest !== null;
    if (nearest === null) return;
    this.#line.moveFirst(nearest.from, nearest.to);
    this.#hidden.moveFirst(nearest.from, nearest.to);
    this.#dots[0]!.position.set(nearest.from[0], nearest.from[1], nearest.from[2]);
    this.#dots[1]!.position.set(nearest.to[0], nearest.to[1], nearest.to[2]);
    const near = nearest.distance_m < nearest.margin_m;
    if (near === this.#near) return;
    this.#near = near;
    this.#paint();
  }

  /** Keeps the dots of one size on the screen. No allocation. */
  face(camera: Camera, eye: Vector3, narrow: number): void {
    for (const dot of this.#dots) dot.scale.setScalar(DOT * narrow * eye.setFromMatrixPosition(camera.matrixWorld).distanceTo(dot.position) * (this.#near ? 1.4 : 1));
  }
}

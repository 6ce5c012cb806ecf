/** What the proof is about: the translucent bodies of arm and tool that count for it, and the smallest clearance as a line from body to body. */
import { type Camera, Color, EdgesGeometry, GreaterDepth, Group, LineBasicMaterial, LineSegments, Mesh, MeshBasicMaterial, ShaderMaterial, SphereGeometry, type Vector3 } from "three";
import type { ClearanceNow } from "../curves.ts";
import type { Body, View } from "../view.ts";
import type { ArmGraph } from "./arm.ts";
import { fix, type Retired } from "./graph.ts";
import { Lines } from "./lines.ts";
import type { Palette } from "./palette.ts";
import { geometryOf } from "./shapes.ts";

const VERTEX = /* glsl */ `
varying vec3 vNormal;
varying vec3 vEye;
void main() {
  vec4 at = modelViewMatrix * vec4(position, 1.0);
  vNormal = normalMatrix * normal;
  vEye = -at.xyz;
  gl_Position = projectionMatrix * at;
}
`;

const FRAGMENT = /* glsl */ `
varying vec3 vNormal;
varying vec3 vEye;
uniform vec3 colour;
void main() {
  float facing = abs(dot(normalize(vNormal), normalize(vEye)));
  gl_FragColor = vec4(colour, mix(0.13, 0.8, pow(1.0 - facing, 2.2)));
  #include <colorspace_fragment>
}
`;

/** Edges sharper than this are drawn as lines [deg]. */
const SHARP_DEG = 25;

/** Made when they are first asked for. */
export class ProofBodies {
  readonly #view: View;
  readonly #arm: ArmGraph;
  readonly #groups: Group[] = [];
  readonly #colour = { value: new Color() };
  readonly #fill = new ShaderMaterial({
    uniforms: { colour: this.#colour },
    vertexShader: VERTEX,
    fragmentShader: FRAGMENT,
    transparent: true,
    depthWrite: false,
    toneMapped: false,
  });
  readonly #edge = new LineBasicMaterial({ transparent: true, opacity: 0.7, depthWrite: false, toneMapped: false });

  constructor(view: View, arm: ArmGraph) {
    this.#view = view;
    this.#arm = arm;
  }

  setPalette(palette: Palette): void {
    this.#colour.value.set(palette.body);
    this.#edge.color.set(palette.body);
  }

  setVisible(on: boolean): void {
    if (on && this.#groups.length === 0) this.#make();
    for (const group of this.#groups) group.visible = on;
  }

  #make(): void {
    for (const link of this.#view.arm.links) {
      this.#arm.frameOf(link)?.add(fix(this.#groupOf(link.collision), link.pose));
    }
    const tool = this.#view.tool;
    if (tool === null || tool.bodies.length === 0) return;
    const { radius_m, height_m, pose } = tool.sponge;
    const sponge: Body = { shape: { cylinder: { radius_m, half_length_m: height_m / 2 } }, pose };
    this.#arm.flange.add(this.#groupOf([...tool.bodies, sponge]));
  }

  #groupOf(bodies: readonly Body[]): Group {
    const group = new Group();
    for (const body of bodies) {
      const geometry = geometryOf(body.shape, "exact");
      const fill = fix(new Mesh(geometry, this.#fill), body.pose);
      fill.renderOrder = 10;
      const edge = fix(new LineSegments(new EdgesGeometry(geometry, SHARP_DEG), this.#edge), body.pose);
      edge.renderOrder = 11;
      group.add(fill, edge);
    }
    this.#groups.push(group);
    return group;
  }

  /** Takes the bodies from the scene. */
  retire(retired: Retired): void {
    for (const group of this.#groups) retired.add(group);
    retired.addMaterial(this.#fill);
    retired.addMaterial(this.#edge);
  }
}

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

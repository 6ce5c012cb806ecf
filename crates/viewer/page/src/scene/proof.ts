/** Translucent bodies of arm and tool that count for the proof: clear where one looks straight at them, dense at their outlines. */
import { Color, EdgesGeometry, Group, LineBasicMaterial, LineSegments, Mesh, ShaderMaterial } from "three";
import type { Body, View } from "../view.ts";
import type { ArmGraph } from "./arm.ts";
import { fix, type Retired } from "./graph.ts";
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

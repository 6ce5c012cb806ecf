/** The tool: its bodies, and a sponge of foam that gives way where a plate presses on it. */
import { type BufferGeometry, Color, Group, LatheGeometry, Matrix4, Mesh, type MeshStandardMaterial, Vector2, Vector3 } from "three";
import { matrixOf } from "../motion.ts";
import type { Plate, Tool } from "../view.ts";
import { meshesOf } from "./arm.ts";
import { fix } from "./graph.ts";
import type { Palette } from "./palette.ts";
import { segmentsRound } from "./shapes.ts";
import type { Studio } from "./stage.ts";

/** Rings of the sponge along its axis. */
const RINGS = 14;

const VERTEX_PARS = /* glsl */ `
#include <common>
uniform vec4 pressPlane;
uniform vec4 pressSize;
varying vec3 vSponge;

/** A place of the free sponge, whose height runs from 0 at the handle to 1 at the far face. */
vec3 pressed(vec3 free) {
  float plane = (pressPlane.w - dot(pressPlane.xy, free.xy)) / pressPlane.z;
  float length = mix(min(pressSize.x, plane), plane, pressSize.z);
  float squash = clamp(1.0 - length / pressSize.x, -0.3, 0.8);
  float bulge = 1.0 + 1.5 * max(squash, 0.0) * free.z * (1.0 - free.z) + 0.25 * max(squash, 0.0) * free.z;
  return vec3(free.xy * bulge, free.z * max(length, 0.1 * pressSize.x));
}
`;

const NORMAL = /* glsl */ `
#include <beginnormal_vertex>
vSponge = vec3(position.xy, position.z * pressSize.x);
if (objectNormal.z > 0.9 && position.z > 0.99) objectNormal = mix(vec3(0.0, 0.0, 1.0), pressPlane.xyz, pressSize.z);
`;

/** Smooth noise in space, from 0 to 1. */
export const NOISE = /* glsl */ `
float noiseHash(vec3 p) {
  p = fract(p * 0.3183099 + vec3(0.71, 0.113, 0.419));
  p *= 17.0;
  return fract(p.x * p.y * p.z * (p.x + p.y + p.z));
}

float noise(vec3 p) {
  vec3 i = floor(p);
  vec3 f = fract(p);
  f = f * f * (3.0 - 2.0 * f);
  vec4 low = vec4(noiseHash(i), noiseHash(i + vec3(1, 0, 0)), noiseHash(i + vec3(0, 1, 0)), noiseHash(i + vec3(1, 1, 0)));
  vec4 high = vec4(noiseHash(i + vec3(0, 0, 1)), noiseHash(i + vec3(1, 0, 1)), noiseHash(i + vec3(0, 1, 1)), noiseHash(i + vec3(1, 1, 1)));
  vec4 layer = mix(low, high, f.z);
  vec2 row = mix(layer.xz, layer.yw, f.x);
  return mix(row.x, row.y, f.y);
}
`;

const FRAGMENT_PARS = /* glsl */ `
#include <common>
varying vec3 vSponge;

${NOISE}`;

const COLOUR = /* glsl */ `
#include <color_fragment>
float fine = clamp(0.0012 / max(length(fwidth(vSponge)), 1e-5), 0.0, 1.0);
float pores = smoothstep(0.6, 0.85, noise(vSponge * 520.0)) + 0.6 * smoothstep(0.55, 0.85, noise(vSponge * 1100.0));
diffuseColor.rgb *= 1.0 - 0.22 * fine * min(pores, 1.0);
`;

/** The free sponge with height 1: an outline with a rounded edge, turned about z. */
export function spongeGeometry(radius: number, edge: number, height: number): BufferGeometry {
  const points = [new Vector2(0, 0), new Vector2(radius - edge, 0), new Vector2(radius - edge, 0)];
  for (let i = 1; i <= 4; i++) {
    const angle = ((i / 4) * Math.PI) / 2;
    points.push(new Vector2(radius - edge + edge * Math.sin(angle), (edge * (1 - Math.cos(angle))) / height));
  }
  for (let k = 1; k < RINGS; k++) points.push(new Vector2(radius, edge / height + (k / RINGS) * (1 - (2 * edge) / height)));
  for (let i = 0; i <= 4; i++) {
    const angle = ((i / 4) * Math.PI) / 2;
    points.push(new Vector2(radius - edge + edge * Math.cos(angle), 1 - (edge * (1 - Math.sin(angle))) / height));
  }
  for (let k = 0; k <= 6; k++) points.push(new Vector2((radius - edge) * (1 - k / 6), 1));
  return new LatheGeometry(points, segmentsRound(radius, 48)).rotateX(Math.PI / 2);
}

/** What the program of the sponge is told, in its own frame with z from the handle to the far face. */
export interface Press {
  /** Unit normal out of the sponge and distance of the plane that it ends at. */
  pressPlane: { value: Float32Array };
  /** Free height [m], how far it is pressed in [m], how much of that is all of it. */
  pressSize: { value: Float32Array };
}

export function foamMaterial(studio: Studio, press: Press): MeshStandardMaterial {
  return studio.material({ roughness: 0.95 }, "sponge", (shader) => {
    Object.assign(shader.uniforms, press);
    shader.vertexShader = shader.vertexShader
      .replace("#include <common>", VERTEX_PARS)
      .replace("#include <beginnormal_vertex>", NORMAL)
      .replace("#include <begin_vertex>", "vec3 transformed = pressed(position);");
    shader.fragmentShader = shader.fragmentShader.replace("#include <common>", FRAGMENT_PARS).replace("#include <color_fragment>", COLOUR);
  });
}

/** A plate's face as the sponge meets it. */
interface Face {
  /** `T_plate_world`. */
  inverse: Matrix4;
  normal: Vector3;
  rim_m: number;
  meridian: [number, number][];
}

function faceOf(plate: Plate): Face {
  const pose = matrixOf(plate.pose);
  const rim_m = plate.meridian_m[plate.meridian_m.length - 1]?.[0] ?? 0;
  return { inverse: pose.clone().invert(), normal: new Vector3().setFromMatrixColumn(pose, 2), rim_m, meridian: plate.meridian_m };
}

/** Height of a face at a distance from its axis [m]; that of its rim beyond. */
function heightAt(meridian: [number, number][], r: number): number {
  for (let k = 1; k < meridian.length; k++) {
    const [r0, z0] = meridian[k - 1]!;
    const [r1, z1] = meridian[k]!;
    if (r <= r1) return r1 > r0 ? z0 + ((z1 - z0) * Math.max(0, r - r0)) / (r1 - r0) : z1;
  }
  return meridian[meridian.length - 1]?.[1] ?? 0;
}

/**
 * The tool at the flange. The free sponge reaches beyond the tip by its compression, which is how far the tip may lift and still touch:
 * as it comes down its face meets the plate, and with the tip in the plate's face it is shorter by the compression, its face at the tip.
 */
export class ToolGraph {
  /** At the flange. */
  readonly root = new Group();
  /** At `T_flange_tip`. */
  readonly tip = new Group();
  readonly visuals: Mesh[] = [];
  #faces: Face[];
  readonly #handles: MeshStandardMaterial[] = [];
  readonly #foam: MeshStandardMaterial | null = null;
  readonly #compression: number = 0;
  readonly #height: number = 0;
  readonly #reach: number = 0;
  readonly #sponge: Mesh | null = null;
  readonly #plane = { value: new Float32Array([0, 0, 1, 1]) };
  readonly #size = { value: new Float32Array([1, 0, 0, 0]) };
  readonly #inverse = new Matrix4();
  readonly #at = new Vector3();
  readonly #normal = new Vector3();

  constructor(tool: Tool | null, plates: readonly Plate[], studio: Studio) {
    this.#faces = plates.map(faceOf);
    this.root.add(this.tip);
    if (tool === null) return;
    fix(this.tip, tool.tip);
    for (const mesh of meshesOf(tool.bodies, studio)) this.#addHandle(mesh);
    const { radius_m, height_m, compression_m, pose } = tool.sponge;
    if (!(radius_m > 0 && height_m > 0) || tool.bodies.length === 0) return;
    this.#compression = Math.max(0, Math.min(compression_m, 0.9 * height_m));
    this.#height = height_m;
    this.#reach = radius_m;
    const free = height_m + this.#compression;
    this.#foam = foamMaterial(studio, { pressPlane: this.#plane, pressSize: this.#size });
    const mesh = new Mesh(spongeGeometry(radius_m, Math.min(0.003, 0.2 * Math.min(radius_m, height_m)), free), this.#foam);
    mesh.matrixAutoUpdate = false;
    mesh.matrix.multiplyMatrices(matrixOf(pose), new Matrix4().makeTranslation(0, 0, -height_m / 2));
    mesh.frustumCulled = false;
    mesh.castShadow = false;
    mesh.receiveShadow = true;
    this.#sponge = mesh;
    this.#size.value[0] = free;
    this.#plane.value[3] = free;
    this.visuals.push(mesh);
    this.root.add(mesh);
  }

  #addHandle(mesh: Mesh): void {
    const material = mesh.material as MeshStandardMaterial;
    material.vertexColors = false;
    material.metalness = 0.55;
    material.roughness = 0.38;
    this.#handles.push(material);
    this.visuals.push(mesh);
    this.root.add(mesh);
  }

  /** The plates that the sponge may press on. */
  setPlates(plates: readonly Plate[]): void {
    this.#faces = plates.map(faceOf);
  }

  setPalette(palette: Palette): void {
    for (const material of this.#handles) material.color = new Color(palette.handle);
    this.#foam?.color.set(palette.sponge);
  }

  /** How far the sponge is pressed in [m], from 0 to its compression. */
  get pressed_m(): number {
    return this.#size.value[1]!;
  }

  /** Presses the sponge on the face that it is over; world matrices must be up to date. No allocation. */
  press(): void {
    if (this.#sponge === null) return;
    const size = this.#size.value;
    size[1] = size[2] = 0;
    this.#plane.value.set(FREE);
    this.#plane.value[3] = size[0]!;
    for (const face of this.#faces) {
      this.#at.setFromMatrixPosition(this.tip.matrixWorld).applyMatrix4(face.inverse);
      const r = Math.hypot(this.#at.x, this.#at.y);
      const height = this.#at.z - heightAt(face.meridian, r);
      if (r > face.rim_m + this.#reach || height > this.#compression || height < -this.#height) continue;
      this.#pressOn(face, Math.max(0, height));
      return;
    }
  }

  /** The tip is `height` above a face [m]: its plane there, in the sponge's frame, is where the sponge ends. */
  #pressOn(face: Face, height: number): void {
    const size = this.#size.value;
    size[1] = this.#compression - height;
    size[2] = this.#compression > 0 ? Math.min(1, size[1]! / this.#compression) : 1;
    this.#inverse.copy(this.#sponge!.matrixWorld).invert();
    this.#at.setFromMatrixPosition(this.tip.matrixWorld).addScaledVector(face.normal, -height).applyMatrix4(this.#inverse);
    this.#normal.copy(face.normal).negate().transformDirection(this.#inverse);
    const plane = this.#plane.value;
    plane[0] = this.#normal.x;
    plane[1] = this.#normal.y;
    plane[2] = Math.max(0.2, this.#normal.z);
    plane[3] = this.#normal.dot(this.#at);
  }
}

const FREE = new Float32Array([0, 0, 1, 0]);

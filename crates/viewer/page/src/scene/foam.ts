/** The sponge's look: a cylinder of foam that ends where a plane presses on it, and bulges. */
import { LatheGeometry, Vector2, type BufferGeometry, type MeshStandardMaterial } from "three";
import { segmentsRound } from "./round.ts";
import type { Studio } from "./studio.ts";

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

const FRAGMENT_PARS = /* glsl */ `
#include <common>
varying vec3 vSponge;

float spongeHash(vec3 p) {
  p = fract(p * 0.3183099 + vec3(0.71, 0.113, 0.419));
  p *= 17.0;
  return fract(p.x * p.y * p.z * (p.x + p.y + p.z));
}

float spongeNoise(vec3 p) {
  vec3 i = floor(p);
  vec3 f = fract(p);
  f = f * f * (3.0 - 2.0 * f);
  vec4 low = vec4(spongeHash(i), spongeHash(i + vec3(1, 0, 0)), spongeHash(i + vec3(0, 1, 0)), spongeHash(i + vec3(1, 1, 0)));
  vec4 high = vec4(spongeHash(i + vec3(0, 0, 1)), spongeHash(i + vec3(1, 0, 1)), spongeHash(i + vec3(0, 1, 1)), spongeHash(i + vec3(1, 1, 1)));
  vec4 layer = mix(low, high, f.z);
  vec2 row = mix(layer.xz, layer.yw, f.x);
  return mix(row.x, row.y, f.y);
}
`;

const COLOUR = /* glsl */ `
#include <color_fragment>
float fine = clamp(0.0012 / max(length(fwidth(vSponge)), 1e-5), 0.0, 1.0);
float pores = smoothstep(0.6, 0.85, spongeNoise(vSponge * 520.0)) + 0.6 * smoothstep(0.55, 0.85, spongeNoise(vSponge * 1100.0));
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

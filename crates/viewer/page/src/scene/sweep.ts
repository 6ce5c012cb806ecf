/** Coverage on a face: a texture says when and for how long each place is swept, and the program compares that with the time. */
import { Color, DataTexture, FloatType, NearestFilter, RGFormat, type WebGLProgramParametersWithUniforms } from "three";
import { type Coverage, timeOf } from "../coverage.ts";

const VERTEX_PARS = /* glsl */ `
#include <common>
attribute float face;
varying vec3 vFace;
`;

const VERTEX = /* glsl */ `
#include <begin_vertex>
vFace = vec3(position.xy, face);
`;

const FRAGMENT_PARS = /* glsl */ `
#include <common>
varying vec3 vFace;
#define FADE 2.5
#define SETTLED 2.0
uniform sampler2D sweeps;
uniform sampler2D heatMap;
uniform vec3 sweepFrame;
uniform vec4 sweepNow;
uniform vec3 sweptColour;
uniform vec3 frontColour;

/** Weights of four neighbours, the second one nearest: a cubic B-spline, which leaves no stairs of the raster. */
vec4 splineWeights(float part) {
  vec4 n = vec4(1.0, 2.0, 3.0, 4.0) - part;
  vec4 s = n * n * n;
  float y = s.y - 4.0 * s.x;
  float z = s.z - 4.0 * s.y + 6.0 * s.x;
  return vec4(s.x, y, z, 6.0 - s.x - y - z) / 6.0;
}

/** Share that is swept, share that was swept just now, mean dwell of all that gets swept, share that ever is. */
vec4 sweptAround(vec2 place) {
  vec2 size = sweepFrame.yz;
  vec2 at = (place / sweepFrame.x * 0.5 + 0.5) * size - 0.5;
  vec2 low = floor(at);
  vec2 top = size - 1.0;
  ivec2 first = ivec2(clamp(low - 1.0, vec2(0.0), top));
  ivec2 last = ivec2(clamp(low + 2.0, vec2(0.0), top));
  vec4 corners = vec4(
    texelFetch(sweeps, first, 0).r,
    texelFetch(sweeps, ivec2(last.x, first.y), 0).r,
    texelFetch(sweeps, ivec2(first.x, last.y), 0).r,
    texelFetch(sweeps, last, 0).r
  );
  // Away from every edge, which is nearly everywhere, the corners say it all.
  bool building = sweepNow.y < 0.5 && all(greaterThanEqual(corners, vec4(0.0)));
  if (building && all(greaterThan(corners, vec4(sweepNow.x)))) return vec4(0.0);
  if (building && all(lessThan(corners, vec4(sweepNow.x - SETTLED)))) return vec4(1.0, 0.0, 0.0, 1.0);
  vec4 across = splineWeights(at.x - low.x);
  vec4 along = splineWeights(at.y - low.y);
  vec4 sum = vec4(0.0);
  float all = 0.0;
  for (int k = 0; k < 16; k++) {
    ivec2 step = ivec2(k & 3, k >> 2);
    vec2 cell = clamp(low + vec2(step - 1), vec2(0.0), size - 1.0);
    vec2 value = texelFetch(sweeps, ivec2(cell), 0).rg;
    float known = value.x < 0.0 ? 0.0 : across[step.x] * along[step.y];
    float ever = value.x < 1.0e8 ? known : 0.0;
    float age = sweepNow.x - value.x;
    float swept = age >= 0.0 ? known : 0.0;
    sum += vec4(swept, swept * exp(-FADE * max(age, 0.0)), ever * value.y, ever);
    all += known;
  }
  return all > 0.0 ? vec4(sum.xy / all, sum.z / max(sum.w, 1e-4), sum.w / all) : vec4(0.0);
}
`;

const COLOUR = /* glsl */ `
#include <color_fragment>
float wet = 0.0;
if (vFace.z > 0.5 && sweepNow.z > 0.0) {
  vec4 sweep = sweptAround(vFace.xy);
  if (sweepNow.y > 0.5) {
    vec3 hot = texture2D(heatMap, vec2(sweep.z / sweepNow.w, 0.5)).rgb;
    float missed = smoothstep(0.55, 0.45, sweep.w);
    diffuseColor.rgb = mix(diffuseColor.rgb, hot, (1.0 - missed) * sweepNow.z);
  } else {
    float soft = clamp(fwidth(sweep.x), 0.06, 0.4);
    wet = smoothstep(0.5 - soft, 0.5 + soft, sweep.x) * sweepNow.z;
    float rim = wet * (1.0 - smoothstep(0.55, 1.0, sweep.x));
    vec3 water = mix(sweptColour, frontColour, clamp(sweep.y * 1.1, 0.0, 1.0));
    diffuseColor.rgb = mix(diffuseColor.rgb, water * (1.0 - 0.12 * rim), 0.88 * wet);
  }
}
`;

const ROUGHNESS = /* glsl */ `
#include <roughnessmap_fragment>
roughnessFactor = mix(roughnessFactor, 0.12, wet);
`;

/** When and for how long [s] each cell is swept, a texel a cell; no time where the cell is beyond the rim. */
export function sweepTexture(coverage: Coverage): DataTexture {
  const { first, dwell, step_s, dwell_step_s, rows, columns } = coverage;
  const data = new Float32Array(2 * first.length);
  first.forEach((step, cell) => {
    data[2 * cell] = timeOf(step, step_s);
    data[2 * cell + 1] = dwell[cell]! * dwell_step_s;
  });
  const texture = new DataTexture(data, columns, rows, RGFormat, FloatType);
  texture.minFilter = texture.magFilter = NearestFilter;
  texture.needsUpdate = true;
  return texture;
}

/** What the program of a plate is told. */
export interface Sweep {
  /** Made by `sweepTexture`. */
  sweeps: { value: DataTexture };
  /** Half of the raster's edge [m], columns, rows. */
  sweepFrame: { value: Float32Array };
  /** Time [s], whether the heat map is shown, how much of anything, the heat map's scale [s]. */
  sweepNow: { value: Float32Array };
}

/** What the programs of all plates are told. */
export interface SweepColours {
  heatMap: { value: DataTexture };
  sweptColour: { value: Color };
  frontColour: { value: Color };
}

/** Has a plate's program draw its coverage. */
export function sweepProgram(shader: WebGLProgramParametersWithUniforms, own: Sweep, colours: SweepColours): void {
  Object.assign(shader.uniforms, own, colours);
  shader.vertexShader = shader.vertexShader.replace("#include <common>", VERTEX_PARS).replace("#include <begin_vertex>", VERTEX);
  shader.fragmentShader = shader.fragmentShader
    .replace("#include <common>", FRAGMENT_PARS)
    .replace("#include <color_fragment>", COLOUR)
    .replace("#include <roughnessmap_fragment>", ROUGHNESS);
}

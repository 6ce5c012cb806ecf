/** Dirt on a face: it lies until the certificate proves that the place has got its dose. What remains is not proved. */
import { Color, DataTexture, FloatType, NearestFilter, RedFormat, type WebGLProgramParametersWithUniforms } from "three";
import { cleanTimes } from "../dirt.ts";
import type { PlateDirt } from "../view.ts";

const PARS = /* glsl */ `
#include <common>
uniform sampler2D dirt;
uniform vec4 dirtFrame;
uniform vec3 dirtColour;

float dirtHash(vec2 at) {
  return fract(sin(dot(at, vec2(127.1, 311.7))) * 43758.5453);
}

float dirtNoise(vec2 at) {
  vec2 low = floor(at);
  vec2 part = smoothstep(0.0, 1.0, at - low);
  vec2 upper = vec2(dirtHash(low + vec2(0.0, 1.0)), dirtHash(low + 1.0));
  vec2 lower = vec2(dirtHash(low), dirtHash(low + vec2(1.0, 0.0)));
  return mix(mix(lower.x, lower.y, part.x), mix(upper.x, upper.y, part.x), part.y);
}

/** Share of the four nearest cells that are dirty at a time, by how near they are. */
float dirtAround(vec2 place, float now) {
  vec2 size = dirtFrame.yz;
  vec2 at = (place / dirtFrame.x * 0.5 + 0.5) * size - 0.5;
  vec2 low = floor(at);
  vec2 part = at - low;
  vec2 sum = vec2(0.0);
  for (int k = 0; k < 4; k++) {
    vec2 step = vec2(k & 1, k >> 1);
    float clean = texelFetch(dirt, ivec2(clamp(low + step, vec2(0.0), size - 1.0)), 0).r;
    vec2 near = mix(1.0 - part, part, step);
    float known = clean < 0.0 ? 0.0 : near.x * near.y;
    sum += vec2(now < clean ? known : 0.0, known);
  }
  return sum.y > 0.0 ? sum.x / sum.y : 1.0;
}
`;

/** Over what is swept. */
const COLOUR = /* glsl */ `
if (vFace.z > 0.5 && dirtFrame.w > 0.0 && sweepNow.y < 0.5) {
  float lies = smoothstep(0.4, 0.6, dirtAround(vFace.xy, sweepNow.x)) * dirtFrame.w;
  if (lies > 0.0) {
    float speck = 0.6 * dirtNoise(vFace.xy * 90.0) + 0.4 * dirtNoise(vFace.xy * 290.0);
    diffuseColor.rgb = mix(diffuseColor.rgb, dirtColour, lies * mix(0.42, 0.92, smoothstep(0.4, 0.68, speck)));
  }
}
#include <roughnessmap_fragment>
`;

/** What the program of a plate is told. */
export interface Soil {
  dirt: { value: DataTexture };
  /** Half of the raster's edge [m], columns, rows, how much of the dirt is drawn. */
  dirtFrame: { value: Float32Array };
}

function textureOf(times: Float32Array, columns: number, rows: number): DataTexture {
  const texture = new DataTexture(times, columns, rows, RedFormat, FloatType);
  texture.minFilter = texture.magFilter = NearestFilter;
  texture.needsUpdate = true;
  return texture;
}

/** The dirt of all plates of a document. */
export class Dirt {
  readonly #colour = { value: new Color() };
  readonly #none = textureOf(new Float32Array([0]), 1, 1);
  #of: readonly PlateDirt[] = [];
  #soils: readonly Soil[] = [];
  #on = true;

  /** What a plate's program is told before there is any dirt. */
  clean(): Soil {
    return { dirt: { value: this.#none }, dirtFrame: { value: new Float32Array([1, 1, 1, 0]) } };
  }

  setColour(colour: string): void {
    this.#colour.value.set(colour);
  }

  setVisible(on: boolean): void {
    this.#on = on;
    for (const { plate } of this.#of) this.#soils[plate]?.dirtFrame.value.set([on ? 1 : 0], 3);
  }

  /** Puts dirt on plates, by their index. */
  lay(of: readonly PlateDirt[], soils: readonly Soil[]): void {
    for (const { dirt, dirtFrame } of [...this.#soils, ...soils]) {
      if (dirt.value !== this.#none) dirt.value.dispose();
      dirt.value = this.#none;
      dirtFrame.value.set([1, 1, 1, 0]);
    }
    [this.#of, this.#soils] = [of, soils];
    for (const plate of of) {
      const soil = soils[plate.plate];
      if (soil === undefined) continue;
      const [rows = 0, columns = 0] = plate.clean.shape;
      soil.dirt.value = textureOf(cleanTimes(plate), columns, rows);
      soil.dirtFrame.value.set([plate.half_m, columns, rows, this.#on ? 1 : 0]);
    }
  }

  /** Has a plate's program, which draws its coverage already, draw dirt over it. */
  program(shader: WebGLProgramParametersWithUniforms, soil: Soil): void {
    Object.assign(shader.uniforms, soil, { dirtColour: this.#colour });
    shader.fragmentShader = shader.fragmentShader.replace("#include <common>", PARS).replace("#include <roughnessmap_fragment>", COLOUR);
  }
}

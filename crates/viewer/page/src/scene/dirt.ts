/** Dirt on a face: it lies until the certificate proves that the place has got its dose. What remains is not proved. */
import { Color, DataTexture, FloatType, RedFormat, type WebGLProgramParametersWithUniforms } from "three";
import { cleanTimes } from "../dirt.ts";
import type { PlateDirt } from "../view.ts";
import { NOISE } from "./tool.ts";

const PARS = /* glsl */ `
#include <common>
uniform sampler2D dirt;
uniform vec3 dirtFrame;
uniform vec3 dirtColour;

${NOISE}
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
if (vFace.z > 0.5 && dirtFrame.x > 0.0 && sweepNow.y < 0.5) {
  float lies = smoothstep(0.4, 0.6, dirtAround(vFace.xy, sweepNow.x));
  if (lies > 0.0) {
    float speck = 0.6 * noise(vec3(vFace.xy * 90.0, 0.0)) + 0.4 * noise(vec3(vFace.xy * 290.0, 0.0));
    diffuseColor.rgb = mix(diffuseColor.rgb, dirtColour, lies * mix(0.42, 0.92, smoothstep(0.4, 0.68, speck)));
  }
}
#include <roughnessmap_fragment>
`;

/** What the program of a plate is told. */
export interface Soil {
  dirt: { value: DataTexture };
  /** Half of the raster's edge [m], 0 without dirt; columns, rows. */
  dirtFrame: { value: Float32Array };
}

function textureOf(times: Float32Array, columns = 1, rows = 1): DataTexture {
  const texture = new DataTexture(times, columns, rows, RedFormat, FloatType);
  texture.needsUpdate = true;
  return texture;
}

/** The dirt of all plates of a document. */
export class Dirt {
  readonly #colour = { value: new Color() };
  readonly #none = textureOf(new Float32Array(1));
  #of: readonly PlateDirt[] = [];
  #soils: readonly Soil[] = [];
  #on = true;

  /** What a plate's program is told before there is any dirt. */
  clean(): Soil {
    return { dirt: { value: this.#none }, dirtFrame: { value: new Float32Array(3) } };
  }

  setColour(colour: string): void {
    this.#colour.value.set(colour);
  }

  setVisible(on: boolean): void {
    if (on === this.#on) return;
    this.#on = on;
    this.lay(this.#of, this.#soils);
  }

  /** Puts dirt on plates, by their index. */
  lay(of: readonly PlateDirt[], soils: readonly Soil[]): void {
    for (const { dirt, dirtFrame } of [...this.#soils, ...soils]) {
      if (dirt.value !== this.#none) dirt.value.dispose();
      dirt.value = this.#none;
      dirtFrame.value.fill(0);
    }
    [this.#of, this.#soils] = [of, soils];
    for (const one of this.#on ? of : []) {
      const [rows = 0, columns = 0] = one.clean.shape;
      const soil = soils[one.plate];
      if (soil !== undefined) soil.dirt.value = textureOf(cleanTimes(one), columns, rows);
      soil?.dirtFrame.value.set([one.half_m, columns, rows]);
    }
  }

  /** Has a plate's program, which draws its coverage already, draw dirt over it. */
  program(shader: WebGLProgramParametersWithUniforms, soil: Soil): void {
    Object.assign(shader.uniforms, soil, { dirtColour: this.#colour });
    shader.fragmentShader = shader.fragmentShader.replace("#include <common>", PARS).replace("#include <roughnessmap_fragment>", COLOUR);
  }
}

/**
 * A photographer's studio as a formula: pale walls, a dim floor, a soft box overhead and a strip behind. It gives all surfaces their
 * reflections and the light from all round without an environment texture, which would have to be filtered before the first frame.
 */
import { Color, MeshStandardMaterial, type MeshStandardMaterialParameters, type WebGLProgramParametersWithUniforms } from "three";
import type { Palette } from "./palette.ts";

const RADIANCE = /* glsl */ `
uniform vec3 studioLevel;

float studioBox(vec3 dir, vec3 axis, vec3 side, vec2 size, float blur) {
  float facing = dot(dir, axis);
  vec2 at = vec2(dot(dir, side), dot(dir, cross(axis, side))) / max(facing, 1e-3);
  vec2 edge = smoothstep(size + blur, size - blur, abs(at));
  return facing > 0.0 ? edge.x * edge.y : 0.0;
}

vec3 studioRadiance(vec3 dir, float roughness) {
  float blur = 0.04 + 0.9 * roughness;
  vec3 wall = mix(vec3(0.30, 0.31, 0.33), vec3(0.92, 0.95, 1.0), smoothstep(-0.35 - blur, 0.75 + blur, dir.z));
  vec3 ground = vec3(0.34, 0.33, 0.32);
  vec3 light = mix(ground, wall, smoothstep(-0.15 - blur, 0.12 + blur, dir.z));
  float spread = 1.0 / (1.0 + 6.0 * blur * blur);
  light += 2.4 * spread * studioBox(dir, normalize(vec3(0.25, -0.3, 0.92)), vec3(0.965, 0.0, -0.262), vec2(0.55, 0.3), blur);
  light += 1.3 * spread * studioBox(dir, normalize(vec3(-0.8, 0.55, 0.25)), vec3(0.298, 0.0, 0.954), vec2(0.7, 0.14), blur);
  return light * studioLevel;
}

vec3 studioIrradiance(vec3 normal) {
  vec3 ground = vec3(0.36, 0.35, 0.34);
  vec3 sky = vec3(0.80, 0.83, 0.87);
  return PI * mix(ground, sky, 0.5 + 0.5 * normal.z) * studioLevel;
}
`;

const LIT = /* glsl */ `
#include <lights_fragment_maps>
{
  vec3 studioNormal = inverseTransformDirection(geometryNormal, viewMatrix);
  vec3 studioDir = inverseTransformDirection(reflect(-geometryViewDir, geometryNormal), viewMatrix);
  radiance += studioRadiance(studioDir, material.roughness);
  iblIrradiance += studioIrradiance(studioNormal);
}
`;

/** What every surface of one scene is lit by. */
export class Studio {
  readonly #level = { value: new Color(1, 1, 1) };

  setPalette(palette: Palette): void {
    this.#level.value.setScalar(palette.ambient);
  }

  /** A surface under this light; `more` may change its program, for which `key` then names the program. */
  material(
    parameters: MeshStandardMaterialParameters,
    key = "",
    more?: (shader: WebGLProgramParametersWithUniforms) => void,
  ): MeshStandardMaterial {
    const material = new MeshStandardMaterial(parameters);
    material.onBeforeCompile = (shader): void => {
      shader.uniforms["studioLevel"] = this.#level;
      shader.fragmentShader = shader.fragmentShader
        .replace("#include <lights_physical_pars_fragment>", `#include <lights_physical_pars_fragment>\n${RADIANCE}`)
        .replace("#include <lights_fragment_maps>", LIT);
      more?.(shader);
    };
    material.customProgramCacheKey = (): string => `studio ${key}`;
    return material;
  }
}

/** The stage: renderer, light, background, shadows, and the studio that lights every surface by a formula. */
import { BufferGeometry, type Camera, Color, DirectionalLight, Float32BufferAttribute, Mesh, MeshStandardMaterial, type MeshStandardMaterialParameters, NeutralToneMapping, PCFShadowMap, Scene as Graph, ShaderMaterial, type Sphere, Vector3, type WebGLProgramParametersWithUniforms, WebGLRenderer } from "three";
import { drawsInSoftware } from "./haste.ts";
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

/** Why there is no scene. */
export class SceneError extends Error {
  override name = "SceneError";
}

/** Screens finer than this are not drawn finer. */
const FINEST = 2;
/** How coarse hasty pictures are: pixels for one. */
const HASTY = 0.5;
const SHADOW_PIXELS = 1024;
const KEY = new Vector3(0.08, -0.72, 1).normalize();

function backdrop(): { mesh: Mesh; top: Color; bottom: Color } {
  const top = new Color();
  const bottom = new Color();
  const material = new ShaderMaterial({
    uniforms: { top: { value: top }, bottom: { value: bottom } },
    depthTest: false,
    depthWrite: false,
    toneMapped: false,
    vertexShader: "varying float height; void main() { height = 0.5 + 0.5 * position.y; gl_Position = vec4(position.xy, 1.0, 1.0); }",
    fragmentShader: /* glsl */ `
      varying float height;
      uniform vec3 top;
      uniform vec3 bottom;
      #include <common>
      #include <dithering_pars_fragment>
      void main() {
        gl_FragColor = vec4(mix(bottom, top, smoothstep(0.0, 1.0, height)), 1.0);
        #include <colorspace_fragment>
        #include <dithering_fragment>
      }`,
    dithering: true,
  });
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new Float32BufferAttribute([-1, -1, 0, 3, -1, 0, -1, 3, 0], 3));
  const mesh = new Mesh(geometry, material);
  mesh.frustumCulled = false;
  mesh.renderOrder = -10;
  return { mesh, top, bottom };
}

/** Without a graphics processor pictures are plain: smooth edges would cost as much again. */
function rendererOn(canvas: HTMLCanvasElement, software: boolean): WebGLRenderer {
  const attributes: WebGLContextAttributes = { antialias: !software, alpha: false, powerPreference: "high-performance" };
  const context = canvas.getContext("webgl2", attributes);
  if (!(context instanceof WebGL2RenderingContext)) {
    throw new SceneError("This browser offers no WebGL 2, which the 3-D view needs: switch on hardware acceleration or try another browser.");
  }
  try {
    return new WebGLRenderer({ canvas, context });
  } catch (error) {
    throw new SceneError(`WebGL 2 does not start: ${error instanceof Error ? error.message : String(error)}`);
  }
}

export class Stage {
  readonly graph = new Graph();
  readonly renderer: WebGLRenderer;
  /** Whether pictures are drawn without a graphics processor. */
  readonly software = drawsInSoftware();
  readonly #key = new DirectionalLight("#fff6ea");
  readonly #backdrop = backdrop();
  #size = { width: 1, height: 1, dpr: 1 };
  #ratio = 0;

  constructor(canvas: HTMLCanvasElement) {
    this.renderer = rendererOn(canvas, this.software);
    // Asking each program for its errors would have them built one after the other.
    this.renderer.debug.checkShaderErrors = false;
    this.renderer.toneMapping = NeutralToneMapping;
    this.renderer.shadowMap.enabled = true;
    this.renderer.shadowMap.type = PCFShadowMap;
    this.renderer.shadowMap.autoUpdate = false;
    this.#key.castShadow = true;
    this.#key.shadow.mapSize.set(SHADOW_PIXELS, SHADOW_PIXELS);
    this.#key.shadow.radius = 4;
    this.#key.shadow.normalBias = 0.004;
    this.#key.shadow.bias = -0.0004;
    this.graph.add(this.#backdrop.mesh, this.#key, this.#key.target);
  }

  /** Lights what lies in a sphere. */
  light(sphere: Sphere): void {
    const reach = Math.min(Math.max(sphere.radius, 0.3), 6) * 1.15;
    this.#key.target.position.copy(sphere.center);
    this.#key.position.copy(sphere.center).addScaledVector(KEY, 3 * reach);
    const camera = this.#key.shadow.camera;
    camera.left = camera.bottom = -reach;
    camera.right = camera.top = reach;
    camera.near = reach;
    camera.far = 5.5 * reach;
    camera.updateProjectionMatrix();
  }

  setPalette(palette: Palette): void {
    this.#backdrop.top.set(palette.top);
    this.#backdrop.bottom.set(palette.bottom);
    this.#key.intensity = palette.key;
  }

  resize(width: number, height: number, dpr: number): void {
    this.#size = { width: Math.max(1, width), height: Math.max(1, height), dpr };
    this.#ratio = 0;
    this.#fit(1);
  }

  /** Gives the canvas so many pixels for one of the screen's; its size on the page stays. */
  #fit(fineness: number): void {
    const { width, height, dpr } = this.#size;
    const ratio = Math.max(0.25, fineness * Math.min(FINEST, dpr));
    if (ratio === this.#ratio) return;
    this.#ratio = ratio;
    this.renderer.setPixelRatio(ratio);
    this.renderer.setSize(width, height, false);
  }

  /** Begins to build all programs at once. */
  prepare(camera: Camera): void {
    this.renderer.compile(this.graph, camera);
  }

  /** Draws, coarsely in haste; the shadows anew only where bodies have moved. */
  draw(camera: Camera, moved: boolean, hasty: boolean): void {
    this.#fit(hasty ? HASTY : 1);
    if (moved) this.renderer.shadowMap.needsUpdate = true;
    this.renderer.render(this.graph, camera);
  }
}

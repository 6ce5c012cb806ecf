/** The stage: renderer, light, background and shadows. */
import {
  BufferGeometry, Color, DirectionalLight, Float32BufferAttribute, Mesh, NeutralToneMapping, PCFShadowMap, Scene as Graph, ShaderMaterial, Vector3, WebGLRenderer, type Camera, type Sphere,
} from "three";
import type { Palette } from "./palette.ts";
import { drawsInSoftware } from "./haste.ts";

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

/** The map of where a plate could be washed: squares just under the plates, finer ones over coarse ones. */
import { Color, DynamicDrawUsage, Float32BufferAttribute, InstancedBufferAttribute, InstancedBufferGeometry, Mesh, ShaderMaterial } from "three";
import type { MapLine } from "../edit/protocol.ts";
import type { Palette } from "./palette.ts";

/** Squares of one size, as they come. */
export type MapPatch = Pick<Extract<MapLine, { kind: "map" }>, "step_m" | "washable_m" | "unwashable_m">;

/** At most so many squares. */
const MOST = 100_000;
/** Squares farther out, or larger, are not drawn [m]. */
const FARTHEST_M = 20;
/** From one size of squares to the next finer one [m]. */
const LEVEL_M = 0.0002;

const VERTEX = /* glsl */ `
attribute vec4 square;
uniform float height;
varying vec2 vPlace;
varying vec2 vInside;
varying float vWashable;
void main() {
  vInside = position.xy;
  vWashable = square.w;
  vPlace = square.xy + 0.5 * square.z * position.xy;
  float level = clamp(-log2(square.z), -4.0, 14.0) + 4.0;
  gl_Position = projectionMatrix * viewMatrix * vec4(vPlace, height + ${LEVEL_M} * level, 1.0);
}
`;

const FRAGMENT = /* glsl */ `
varying vec2 vPlace;
varying vec2 vInside;
varying float vWashable;
uniform vec3 washable;
uniform vec3 unwashable;
void main() {
  float x = (vPlace.x + vPlace.y) / 0.02;
  float blur = fwidth(x);
  float stripe = mix(smoothstep(0.62 - blur, 0.62 + blur, abs(fract(x) - 0.5) * 2.0), 0.38, smoothstep(0.4, 0.9, blur));
  vec2 border = abs(vInside);
  vec2 thin = max(fwidth(vInside), vec2(1e-4));
  float edge = smoothstep(0.0, 1.0, (max(border.x - 1.0 + thin.x, border.y - 1.0 + thin.y)) / max(thin.x, thin.y));
  vec3 colour = vWashable > 0.5 ? washable : unwashable * mix(1.0, 0.62, stripe);
  float alpha = vWashable > 0.5 ? 0.75 : mix(0.5, 0.72, stripe);
  gl_FragColor = vec4(mix(colour, colour * 0.86, 0.5 * edge), alpha);
  #include <colorspace_fragment>
}
`;

/**
 * Squares of all patches as x, y, edge [m], and 1 for washable: finest first, so that coarse ones under them, which are drawn later, do
 * not shine through.
 */
export function squaresOf(patches: readonly MapPatch[]): Float32Array {
  const drawable = ([x, y]: readonly [number, number]): boolean => Math.abs(x) < FARTHEST_M && Math.abs(y) < FARTHEST_M;
  const order = patches.filter(({ step_m }) => step_m > 0 && step_m < FARTHEST_M).sort((a, b) => a.step_m - b.step_m);
  const squares: number[] = [];
  for (const { step_m, washable_m, unwashable_m } of order) {
    for (const [list, flag] of [[washable_m, 1], [unwashable_m, 0]] as const) {
      for (const centre of list) if (squares.length < 4 * MOST && drawable(centre)) squares.push(centre[0], centre[1], step_m, flag);
    }
  }
  return Float32Array.from(squares);
}

export class WashMap {
  readonly mesh: Mesh<InstancedBufferGeometry, ShaderMaterial>;
  readonly #colours = { washable: { value: new Color() }, unwashable: { value: new Color() } };
  readonly #height = { value: 0.002 };
  #patches: MapPatch[] = [];

  constructor() {
    const material = new ShaderMaterial({
      uniforms: { ...this.#colours, height: this.#height },
      vertexShader: VERTEX,
      fragmentShader: FRAGMENT,
      transparent: true,
      toneMapped: false,
    });
    this.mesh = new Mesh(square(64), material);
    this.mesh.frustumCulled = false;
    this.mesh.renderOrder = -1;
    this.mesh.visible = false;
  }

  setPalette(palette: Palette): void {
    this.#colours.washable.value.set(palette.mapWashable);
    this.#colours.unwashable.value.set(palette.mapUnwashable);
  }

  /** At which height squares are drawn [m]. */
  setHeight(height_m: number): void {
    this.#height.value = height_m;
  }

  /** Adds squares; null takes all away. */
  add(patch: MapPatch | null): void {
    this.#patches = patch === null ? [] : [...this.#patches, patch];
    const squares = squaresOf(this.#patches);
    const count = squares.length / 4;
    let attribute = this.mesh.geometry.getAttribute("square");
    if (attribute.count < count) {
      this.mesh.geometry.dispose();
      this.mesh.geometry = square(2 ** Math.ceil(Math.log2(count)));
      attribute = this.mesh.geometry.getAttribute("square");
    }
    (attribute.array as Float32Array).set(squares);
    attribute.needsUpdate = true;
    this.mesh.geometry.instanceCount = count;
    this.mesh.visible = count > 0;
  }
}

/** A square with room for so many instances. */
function square(room: number): InstancedBufferGeometry {
  const geometry = new InstancedBufferGeometry();
  geometry.setAttribute("position", new Float32BufferAttribute([-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0], 3));
  geometry.setIndex([0, 1, 2, 0, 2, 3]);
  const squares = new InstancedBufferAttribute(new Float32Array(4 * room), 4);
  squares.setUsage(DynamicDrawUsage);
  geometry.setAttribute("square", squares);
  geometry.instanceCount = 0;
  return geometry;
}

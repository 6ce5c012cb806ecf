/**
 * What is said of plates before they are planned, drawn over their faces: a tint with a pattern for each guess, and the part of a face
 * that cannot be washed, hatched.
 */
import { type BufferGeometry, Color, DataTexture, Group, LinearFilter, Mesh, RedFormat, ShaderMaterial } from "three";
import type { Chance, UnwashableReport } from "../edit/protocol.ts";
import type { Solid } from "./handles.ts";
import type { Palette } from "./palette.ts";

/** Cells along either edge. */
export const CELLS = 96;

/** Squared distance from a place to the nearest of points, x and y one after the other. */
function leastSquared(points: Float64Array, x: number, y: number): number {
  let least = Infinity;
  for (let k = 0; k < points.length; k += 2) least = Math.min(least, (points[k]! - x) ** 2 + (points[k + 1]! - y) ** 2);
  return least;
}

/**
 * The square of half edge `half_m` about a plate's axis, row by row from the least y, x ascending: 255 where a place is nearer to a dead
 * point than to any free one, else 0. Points are in the plate's frame; those that are not finite, or off the square, do not count.
 */
export function deadNearer(free: readonly (readonly number[])[], dead: readonly (readonly number[])[], half_m: number): Uint8Array {
  const raster = new Uint8Array(CELLS * CELLS);
  const within = (points: readonly (readonly number[])[]): Float64Array =>
    Float64Array.from(points.filter(([x = Number.NaN, y = Number.NaN]) => Math.max(Math.abs(x), Math.abs(y)) <= 1.5 * half_m).flatMap(([x, y]) => [x!, y!]));
  const [lost, reached] = [within(dead), within(free)];
  const middleOf = (k: number): number => ((2 * k + 1) / CELLS - 1) * half_m;
  if (lost.length === 0) return raster;
  for (let cell = 0; cell < raster.length; cell++) {
    const [x, y] = [middleOf(cell % CELLS), middleOf(Math.floor(cell / CELLS))];
    if (leastSquared(lost, x, y) < leastSquared(reached, x, y)) raster[cell] = 255;
  }
  return raster;
}

const VERTEX = /* glsl */ `
attribute float face;
varying vec3 vFace;
void main() {
  vFace = vec3(position.xy, face);
  gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
}
`;

/** `guess`: 0 for none, then as in `GUESSES`. `deadHalf`: half of the raster's edge [m], 0 for none. */
const FRAGMENT = /* glsl */ `
varying vec3 vFace;
uniform float guess;
uniform float deadHalf;
uniform sampler2D dead;
uniform vec3 washable;
uniform vec3 unclear;
uniform vec3 unwashable;

/** Stripes so far apart [m], of which the share \`width\` is ink; plain grey where they are too fine to be seen. */
float stripes(float at, float period, float width) {
  float x = at / period;
  float blur = fwidth(x);
  float d = abs(fract(x) - 0.5) * 2.0;
  return mix(smoothstep(1.0 - width - blur, 1.0 - width + blur, d), width, smoothstep(0.4, 0.9, blur));
}

void main() {
  if (vFace.z < 0.5) discard;
  vec2 p = vFace.xy;
  vec4 ink = vec4(0.0);
  if (guess > 2.5) ink = vec4(unwashable, 0.22 + (deadHalf > 0.0 ? 0.0 : 0.5 * stripes(p.x + p.y, 0.024, 0.3)));
  else if (guess > 1.5) ink = vec4(unclear, 0.16 + 0.5 * stripes(p.x, 0.024, 0.32) * stripes(p.y, 0.024, 0.32));
  else if (guess > 0.5) ink = vec4(washable, 0.2);
  if (deadHalf > 0.0) {
    float share = texture2D(dead, p / deadHalf * 0.5 + 0.5).r;
    float blur = max(fwidth(share), 0.02);
    float inside = smoothstep(0.5 - blur, 0.5 + blur, share);
    float edge = inside * (1.0 - smoothstep(0.5, 0.5 + 2.5 * blur, share));
    float hatch = max(stripes(p.x + p.y, 0.012, 0.38), stripes(p.x - p.y, 0.024, 0.2));
    ink = mix(ink, vec4(unwashable, max(edge, 0.4 + 0.5 * hatch)), inside);
  }
  if (ink.a <= 0.0) discard;
  gl_FragColor = ink;
  #include <colorspace_fragment>
}
`;

const GUESSES: Record<Chance, number> = { washable: 1, unclear: 2, unwashable: 3 };

/** A part of a plate as it was found where the plate then lay. */
interface Part {
  texture: DataTexture;
  half_m: number;
  centre_m: [number, number];
}

interface Overlay {
  mesh: Mesh<BufferGeometry, ShaderMaterial>;
  guess: { value: number };
  deadHalf: { value: number };
  dead: { value: DataTexture | null };
}

export type Offending = Pick<UnwashableReport, "plate" | "free_m" | "dead_m">;

export class Washability {
  readonly root = new Group();
  readonly #colours = { washable: { value: new Color() }, unclear: { value: new Color() }, unwashable: { value: new Color() } };
  readonly #overlays: Overlay[] = [];
  readonly #parts = new Map<number, Part>();
  #chances = new Map<number, Chance>();

  constructor() {
    // One stays from the start, so that its program is built before the first is shown.
    this.#overlays.push(this.#make());
  }

  setPalette(palette: Palette): void {
    for (const kind of ["washable", "unclear", "unwashable"] as const) this.#colours[kind].value.set(palette[kind]);
  }

  setChances(list: readonly { plate: number; chance: Chance }[]): void {
    this.#chances = new Map(list.map(({ plate, chance }) => [plate, chance]));
  }

  chanceOf(plate: number): Chance | null {
    return this.#chances.get(plate) ?? null;
  }

  /** The parts of plates that cannot be washed, of plates that lie as in `solids`. */
  setOffending(list: readonly Offending[], solids: readonly Solid[]): void {
    for (const { texture } of this.#parts.values()) texture.dispose();
    this.#parts.clear();
    for (const { plate, free_m, dead_m } of list) {
      const solid = solids[plate];
      if (solid !== undefined && dead_m.length > 0) this.#parts.set(plate, partOf(solid, free_m, dead_m));
    }
  }

  /** Draws over the plates as they lie; a part that was found elsewhere does not count. */
  show(solids: readonly Solid[], shape: (plate: number) => BufferGeometry | null): void {
    while (this.#overlays.length < solids.length && (this.#chances.size > 0 || this.#parts.size > 0)) this.#overlays.push(this.#make());
    this.#overlays.forEach((overlay, plate) => {
      const { mesh, guess, deadHalf, dead } = overlay;
      const [solid, geometry, chance, part] = [solids[plate], shape(plate), this.#chances.get(plate), this.#parts.get(plate)];
      const here = solid !== undefined && part !== undefined && isAt(solid, part.centre_m);
      mesh.visible = solid !== undefined && geometry !== null && (chance !== undefined || here);
      // Programs depend on what triangles come with, so that hidden overlays have them, too.
      if (geometry !== null) mesh.geometry = geometry;
      if (!mesh.visible || solid === undefined) return;
      guess.value = chance === undefined ? 0 : GUESSES[chance];
      deadHalf.value = here ? part.half_m : 0;
      dead.value = here ? part.texture : null;
      mesh.matrix.copy(solid.pose);
      mesh.matrixWorldNeedsUpdate = true;
    });
  }

  #make(): Overlay {
    const own: Omit<Overlay, "mesh"> = { guess: { value: 0 }, deadHalf: { value: 0 }, dead: { value: null } };
    const material = new ShaderMaterial({
      uniforms: { ...own, ...this.#colours },
      vertexShader: VERTEX,
      fragmentShader: FRAGMENT,
      transparent: true,
      depthWrite: false,
      toneMapped: false,
    });
    const mesh = new Mesh<BufferGeometry, ShaderMaterial>(undefined, material);
    mesh.matrixAutoUpdate = false;
    mesh.renderOrder = 1;
    mesh.visible = false;
    this.root.add(mesh);
    return { mesh, ...own };
  }
}

function isAt({ pose }: Solid, [x, y]: [number, number]): boolean {
  return Math.hypot(pose.elements[12]! - x, pose.elements[13]! - y) < 1e-6;
}

type Points = readonly (readonly [number, number, number])[];

function partOf({ pose, rim_m }: Solid, free_m: Points, dead_m: Points): Part {
  const e = pose.elements;
  const flat = (points: Points): [number, number][] =>
    points.map((point) => {
      const [x, y, z] = [point[0] - e[12]!, point[1] - e[13]!, point[2] - e[14]!];
      return [e[0]! * x + e[1]! * y + e[2]! * z, e[4]! * x + e[5]! * y + e[6]! * z];
    });
  const texture = new DataTexture(deadNearer(flat(free_m), flat(dead_m), rim_m), CELLS, CELLS, RedFormat);
  texture.minFilter = texture.magFilter = LinearFilter;
  texture.needsUpdate = true;
  return { texture, half_m: rim_m, centre_m: [e[12]!, e[13]!] };
}

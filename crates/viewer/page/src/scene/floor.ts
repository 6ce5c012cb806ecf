/** The floor: the paper's grey patch, a grid that fades, shadows, and what the job keeps to: base circle and region. */
import { Color, Group, Mesh, MeshBasicMaterial, PlaneGeometry, ShadowMaterial, Shape, ShapeGeometry, Vector2 } from "three";
import type { View } from "../view.ts";
import { Lines, stretches } from "./lines.ts";
import type { Palette } from "./palette.ts";
import type { Studio } from "./stage.ts";

/** Half of the patch's edge [m]. */
export const PATCH_M = 0.5;
/** How far the ground lies below the patch [m]. */
const GROUND_M = 0.0015;

/** How far over what they are on base circle and region are drawn [m]. */
const OVER_M = 0.0015;
/** Plates whose undersides are lower than this are taken to lie on the floor [m]. */
const RAISED_M = 0.1;

/** Where the middle of the patch is: below an arm that stands upright on the floor; nowhere for one that is mounted elsewhere. */
export function patchAt({ arm }: Pick<View, "arm">): [number, number] | null {
  const { position_m: [x, y, z], quaternion_wxyz: [, i, j] } = arm.mount;
  return Math.abs(z) < 1e-3 && Math.hypot(i, j) < 1e-6 ? [x, y] : null;
}

/** Height at which base circle and region are drawn [m]: on the floor, or under plates that lie level on something higher. */
export function marksHeight({ plates }: Pick<View, "plates">): number {
  const level = plates.every(({ pose: { quaternion_wxyz: [, i, j] } }) => Math.hypot(i, j) < 1e-6);
  const under = Math.min(...plates.map((plate) => plate.pose.position_m[2] - plate.thickness_m - (plate.foot?.height_m ?? 0)));
  return (level && Number.isFinite(under) && under > RAISED_M ? under : 0) + OVER_M;
}

const GRID_VERTEX = /* glsl */ `
#include <worldpos_vertex>
vGround = (modelMatrix * vec4(position, 1.0)).xy;
`;

const GRID = /* glsl */ `
vec2 groundWidth = fwidth(vGround);
float fineness = max(groundWidth.x, groundWidth.y);
vec2 tenth = abs(fract(vGround * 10.0 - 0.5) - 0.5) / (groundWidth * 10.0 + 1e-6);
vec2 whole = abs(fract(vGround - 0.5) - 0.5) / (groundWidth + 1e-6);
float lineTenth = (1.0 - min(min(tenth.x, tenth.y), 1.0)) * smoothstep(0.03, 0.006, fineness) * 0.16;
float lineWhole = (1.0 - min(min(whole.x, whole.y), 1.0)) * smoothstep(0.3, 0.05, fineness) * 0.34;
float grid = max(lineTenth, lineWhole);
float far = smoothstep(1.0, 0.35, length(vGround - groundFrame.xy) / groundFrame.z);
float shade = opacity * (1.0 - getShadowMask());
float alpha = 1.0 - (1.0 - grid) * (1.0 - shade);
vec3 ink = mix(color, gridColour, alpha > 0.0 ? grid / max(alpha, 1e-4) : 0.0);
gl_FragColor = vec4(ink, alpha * far);
`;

function roundedPatch(): ShapeGeometry {
  const r = 0.012;
  const e = PATCH_M;
  const shape = new Shape();
  shape.moveTo(-e + r, -e).lineTo(e - r, -e).absarc(e - r, -e + r, r, -Math.PI / 2, 0, false);
  shape.lineTo(e, e - r).absarc(e - r, e - r, r, 0, Math.PI / 2, false);
  shape.lineTo(-e + r, e).absarc(-e + r, e - r, r, Math.PI / 2, Math.PI, false);
  shape.lineTo(-e, -e + r).absarc(-e + r, -e + r, r, Math.PI, 1.5 * Math.PI, false);
  return new ShapeGeometry(shape, 6);
}

function circle(radius: number, height: number): number[] {
  return Array.from({ length: 129 }, (_, i) => {
    const angle = (i / 64) * Math.PI;
    return [radius * Math.cos(angle), radius * Math.sin(angle), height];
  }).flat();
}

/** The floor and its marks. */
export class Floor {
  readonly ground = new Group();
  readonly region = new Group();
  readonly #patch;
  readonly #shadow = new ShadowMaterial({ transparent: true, depthWrite: false, toneMapped: false });
  readonly #grid = { value: new Color() };
  readonly #frame = { value: new Float32Array([0, 0, 2]) };
  readonly #lines: Lines[] = [];
  readonly #fill: MeshBasicMaterial | null = null;
  readonly #plane: Mesh;

  constructor(view: View, studio: Studio) {
    const { surroundings, arm: { mount: { position_m: base } } } = view;
    const [middle, height] = [patchAt(view), marksHeight(view)];
    this.#patch = studio.material({ roughness: 0.9 });
    const patch = new Mesh(roundedPatch(), this.#patch);
    patch.receiveShadow = true;
    patch.visible = middle !== null;
    patch.position.set(middle?.[0] ?? 0, middle?.[1] ?? 0, 0);
    this.#plane = new Mesh(new PlaneGeometry(1, 1), this.#shadow);
    this.#plane.position.z = -GROUND_M;
    this.#plane.receiveShadow = true;
    this.#plane.renderOrder = -1;
    this.#shadow.onBeforeCompile = (shader): void => {
      Object.assign(shader.uniforms, { gridColour: this.#grid, groundFrame: this.#frame });
      shader.vertexShader = `varying vec2 vGround;\n${shader.vertexShader}`.replace("#include <worldpos_vertex>", GRID_VERTEX);
      shader.fragmentShader = `varying vec2 vGround;\nuniform vec3 gridColour;\nuniform vec3 groundFrame;\n${shader.fragmentShader}`.replace(
        "gl_FragColor = vec4( color, opacity * ( 1.0 - getShadowMask() ) );",
        GRID,
      );
    };
    this.ground.add(this.#plane, patch);
    const { base_circle_m: radius, polygon_m: region } = surroundings;
    if (radius !== null && radius > 0) this.#outline(circle(radius, height).map((x, i) => x + (i % 3 < 2 ? base[i % 3]! : 0)), [0.02, 0.014]);
    if (region !== null && region.length > 2) this.#fill = this.#area(region, height);
  }

  #area(region: [number, number][], height: number): MeshBasicMaterial {
    const fill = new MeshBasicMaterial({ transparent: true, opacity: 0.07, depthWrite: false, toneMapped: false });
    const mesh = new Mesh(new ShapeGeometry(new Shape(region.map(([x, y]) => new Vector2(x, y)))), fill);
    mesh.position.z = height - 0.0005;
    this.region.add(mesh);
    this.#outline([...region, region[0]!].flatMap(([x, y]) => [x, y, height]));
    return fill;
  }

  #outline(places: number[], dash_m?: [number, number]): void {
    const lines = new Lines(stretches([places]), { width: 1.6, ...(dash_m === undefined ? {} : { dash_m }) });
    this.#lines.push(lines);
    this.region.add(lines);
  }

  /** Lets the ground reach as far round `centre` as `radius` [m]. */
  setExtent(centre: { x: number; y: number }, radius: number): void {
    this.#frame.value.set([centre.x, centre.y, radius]);
    this.#plane.position.set(centre.x, centre.y, -GROUND_M);
    this.#plane.scale.set(2 * radius, 2 * radius, 1);
  }

  setPalette(palette: Palette): void {
    this.#patch.color.set(palette.patch);
    this.#shadow.opacity = palette.shadow;
    this.#grid.value.set(palette.grid);
    this.#fill?.color.set(palette.region);
    for (const lines of this.#lines) lines.setColour(palette.region);
  }
}

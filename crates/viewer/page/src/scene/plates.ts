/** Plates: porcelain, with the coverage on the face. */
import { type BufferGeometry, Color, DataTexture, FloatType, Group, LinearFilter, Matrix4, Mesh, type MeshStandardMaterial, type Object3D, RGBAFormat, RGFormat, SRGBColorSpace } from "three";
import { colormap, type Coverage, dwellScale } from "../coverage.ts";
import { matrixOf } from "../motion.ts";
import type { Plate, PlateDirt } from "../view.ts";
import { Dirt, type Soil } from "./dirt.ts";
import { fix, type Retired } from "./graph.ts";
import type { Solid } from "./handles.ts";
import type { Palette } from "./palette.ts";
import { plateGeometry } from "./shapes.ts";
import type { Studio } from "./stage.ts";
import { type Sweep, type SweepColours, sweepProgram, sweepTexture } from "./sweep.ts";

/** Which motion's coverage is shown. */
export type CoverageKind = "planned" | "executed";

interface Rasters {
  textures: Map<number, DataTexture>;
  of: readonly Coverage[];
  scale_s: number;
}

/** A plate as it is drawn. */
interface Drawn {
  plate: Plate;
  /** Of its shape. */
  key: string;
  mesh: Mesh<BufferGeometry, MeshStandardMaterial>;
  own: Sweep;
  soil: Soil;
  moved: boolean;
}

/** How much of the coverage is shown of a plate that lies elsewhere now. */
const FAINT = 0.18;
/** Centres nearer to each other than this are the same [m]. */
const SAME_M = 1e-7;

function rastersOf(of: readonly Coverage[]): Rasters {
  return { textures: new Map(), of, scale_s: dwellScale(of) };
}

function solidOf(plate: Plate, pose: Matrix4): Solid {
  const heights = plate.meridian_m.map(([, z]) => z).filter(Number.isFinite);
  const top_m = heights.length > 0 ? Math.max(...heights) : 0;
  const bottom_m = (heights.length > 0 ? Math.min(...heights) : 0) - Math.max(0, plate.thickness_m || 0) - Math.max(0, plate.foot?.height_m || 0);
  return { pose, rim_m: plate.meridian_m.at(-1)?.[0] ?? 0, top_m, bottom_m };
}

function heatTexture(): DataTexture {
  const texture = new DataTexture(colormap(), 256, 1, RGBAFormat);
  texture.colorSpace = SRGBColorSpace;
  texture.minFilter = texture.magFilter = LinearFilter;
  texture.needsUpdate = true;
  return texture;
}

/** All plates of a document. */
export class Plates {
  readonly root = new Group();
  readonly dirt = new Dirt();
  readonly #studio: Studio;
  readonly #retired: Retired;
  readonly #shapes = new Map<string, BufferGeometry>();
  readonly #rasters: Record<CoverageKind, Rasters> = { planned: rastersOf([]), executed: rastersOf([]) };
  readonly #empty: DataTexture;
  readonly #colours: SweepColours = { heatMap: { value: heatTexture() }, sweptColour: { value: new Color() }, frontColour: { value: new Color() } };
  #drawn: Drawn[] = [];
  #porcelain = new Color();
  #kind: CoverageKind | null = null;
  #on = true;

  constructor(studio: Studio, retired: Retired) {
    this.#studio = studio;
    this.#retired = retired;
    this.#empty = new DataTexture(new Float32Array([-1, 0]), 1, 1, RGFormat, FloatType);
    this.#empty.needsUpdate = true;
  }

  get count(): number {
    return this.#drawn.length;
  }

  /** Draws other plates: meshes of the same shape are moved, others made. */
  replace(plates: readonly Plate[]): void {
    const segments = plates.length > 24 ? 48 : 128;
    const before = this.#drawn;
    this.#drawn = plates.map((plate, index) => {
      const key = JSON.stringify([plate.meridian_m, plate.thickness_m, plate.foot, plate.relief, segments]);
      const kept = before[index];
      if (kept === undefined || kept.key !== key) return this.#make(plate, key, segments);
      fix(kept.mesh, plate.pose);
      return { ...kept, plate, moved: false };
    });
    for (const { mesh } of before) if (!this.#drawn.some((drawn) => drawn.mesh === mesh)) this.#drop(mesh);
    for (const [key, geometry] of this.#shapes) {
      if (this.#drawn.some((drawn) => drawn.key === key)) continue;
      geometry.dispose();
      this.#shapes.delete(key);
    }
    this.#kind = null;
  }

  /** What draws each plate, and the plate as the document has it. */
  get objects(): (Solid & { object: Object3D })[] {
    return this.#drawn.map(({ plate, mesh }) => ({ object: mesh, ...solidOf(plate, matrixOf(plate.pose)) }));
  }

  /** Shapes are freed apart, as plates share them. */
  #drop(mesh: Drawn["mesh"]): void {
    mesh.removeFromParent();
    this.#retired.addMaterial(mesh.material);
  }

  /** Shows another coverage. */
  cover(kind: CoverageKind, coverage: readonly Coverage[]): void {
    for (const texture of this.#rasters[kind].textures.values()) texture.dispose();
    this.#rasters[kind] = rastersOf(coverage);
    this.#kind = null;
  }

  /** Lays other dirt on the plates. */
  lay(dirt: readonly PlateDirt[]): void {
    this.dirt.lay(dirt, this.#drawn.map(({ soil }) => soil));
  }

  #make(plate: Plate, key: string, segments: number): Drawn {
    const geometry = this.#shapes.get(key) ?? plateGeometry(plate, segments);
    this.#shapes.set(key, geometry);
    const own: Sweep = {
      sweeps: { value: this.#empty },
      sweepFrame: { value: new Float32Array([1, 1, 1]) },
      sweepNow: { value: new Float32Array([0, 0, 0, 1]) },
    };
    const soil = this.dirt.clean();
    const look = { roughness: 0.22, polygonOffset: true, polygonOffsetFactor: 2, polygonOffsetUnits: 8, color: this.#porcelain };
    const material = this.#studio.material(look, "plate", (shader) => {
      sweepProgram(shader, own, this.#colours);
      this.dirt.program(shader, soil);
    });
    const mesh = fix(new Mesh(geometry, material), plate.pose);
    mesh.castShadow = mesh.receiveShadow = true;
    this.root.add(mesh);
    return { plate, key, mesh, own, soil, moved: false };
  }

  setPalette(palette: Palette): void {
    this.#colours.sweptColour.value.set(palette.washed);
    this.#colours.frontColour.value.set(palette.front);
    this.dirt.setColour(palette.dirt);
    this.#porcelain.set(palette.porcelain);
    for (const { mesh } of this.#drawn) mesh.material.color.copy(this.#porcelain);
  }

  setCoverage(on: boolean): void {
    this.#on = on;
  }

  /** Draws a plate with its centre elsewhere, or where the document has it; then its coverage is that of this place. */
  move(index: number, centre_m: readonly [number, number] | null): void {
    const drawn = this.#drawn[index];
    if (drawn === undefined) return;
    const [x, y] = drawn.plate.pose.position_m;
    const [to_x, to_y] = centre_m ?? [x, y];
    drawn.moved = Math.hypot(to_x - x, to_y - y) > SAME_M;
    drawn.mesh.matrix.elements[12] = to_x;
    drawn.mesh.matrix.elements[13] = to_y;
    drawn.mesh.matrixWorldNeedsUpdate = true;
    drawn.own.sweepNow.value[2] = this.#strength(drawn);
  }

  /** Plates that are drawn elsewhere than the document has them. */
  get moved(): Set<number> {
    return new Set(this.#drawn.flatMap(({ moved }, index) => (moved ? [index] : [])));
  }

  /** The plates as rays meet them: where they are drawn. */
  get solids(): Solid[] {
    return this.#drawn.map(({ plate, mesh }) => solidOf(plate, mesh.matrix));
  }

  /** The triangles of a plate, to be drawn over. */
  shape(index: number): BufferGeometry | null {
    return this.#drawn[index]?.mesh.geometry ?? null;
  }

  /** Shows the coverage as it is at `t` [s], or all of it as heat map. No allocation but where the kind changes. */
  show(t: number, kind: CoverageKind, heat: boolean): void {
    if (kind !== this.#kind) this.#bind(kind);
    const scale = this.#rasters[kind].scale_s;
    for (const drawn of this.#drawn) {
      const now = drawn.own.sweepNow.value;
      now[0] = t;
      now[1] = heat ? 1 : 0;
      now[2] = this.#strength(drawn);
      now[3] = scale;
    }
  }

  #strength({ moved }: Drawn): number {
    if (!this.#on) return 0;
    return moved ? FAINT : 1;
  }

  #bind(kind: CoverageKind): void {
    this.#kind = kind;
    const { textures, of } = this.#rasters[kind];
    for (const { own } of this.#drawn) {
      own.sweeps.value = this.#empty;
      own.sweepFrame.value.fill(1);
    }
    for (const coverage of of) {
      const own = this.#drawn[coverage.plate]?.own;
      if (own === undefined || !(coverage.half_m > 0)) continue;
      const texture = textures.get(coverage.plate) ?? sweepTexture(coverage);
      textures.set(coverage.plate, texture);
      own.sweeps.value = texture;
      own.sweepFrame.value.set([coverage.half_m, coverage.columns, coverage.rows]);
    }
  }
}

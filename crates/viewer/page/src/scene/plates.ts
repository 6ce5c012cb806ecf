/** Plates: porcelain, with the coverage on the face. */
import { Color, DataTexture, FloatType, Group, LinearFilter, Mesh, RGBAFormat, RGFormat, SRGBColorSpace, type BufferGeometry } from "three";
import { colormap } from "../colormap.ts";
import { dwellScale, type Coverage } from "../coverage.ts";
import type { Plate } from "../view.ts";
import type { Palette } from "./palette.ts";
import { plateGeometry } from "./plate-shape.ts";
import { fix } from "./pose.ts";
import type { Studio } from "./studio.ts";
import { sweepProgram, sweepTexture, type Sweep, type SweepColours } from "./sweep.ts";

/** Which motion's coverage is shown. */
export type CoverageKind = "planned" | "executed";

interface Rasters {
  textures: Map<number, DataTexture>;
  of: readonly Coverage[];
  scale_s: number;
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
  readonly #meshes: Mesh[] = [];
  readonly #rasters: Record<CoverageKind, Rasters>;
  readonly #empty: DataTexture;
  readonly #colours: SweepColours = { heatMap: { value: heatTexture() }, sweptColour: { value: new Color() }, frontColour: { value: new Color() } };
  readonly #uniforms: Sweep[] = [];
  readonly #materials: ReturnType<Studio["material"]>[] = [];
  #kind: CoverageKind | null = null;
  #on = true;

  constructor(plates: readonly Plate[], coverage: Record<CoverageKind, readonly Coverage[]>, studio: Studio) {
    const rasters = (of: readonly Coverage[]): Rasters => ({ textures: new Map(), of, scale_s: dwellScale(of) });
    this.#rasters = { planned: rasters(coverage.planned), executed: rasters(coverage.executed) };
    this.#empty = new DataTexture(new Float32Array([-1, 0]), 1, 1, RGFormat, FloatType);
    this.#empty.needsUpdate = true;
    const shapes = new Map<string, BufferGeometry>();
    const segments = plates.length > 24 ? 48 : 128;
    for (const plate of plates) this.#add(plate, shapes, segments, studio);
  }

  #add(plate: Plate, shapes: Map<string, BufferGeometry>, segments: number, studio: Studio): void {
    const key = JSON.stringify([plate.meridian_m, plate.thickness_m]);
    const geometry = shapes.get(key) ?? plateGeometry(plate, segments);
    shapes.set(key, geometry);
    const own: Sweep = {
      sweeps: { value: this.#empty },
      sweepFrame: { value: new Float32Array([1, 1, 1]) },
      sweepNow: { value: new Float32Array([0, 0, 0, 1]) },
    };
    const material = studio.material({ roughness: 0.22, polygonOffset: true, polygonOffsetFactor: 2, polygonOffsetUnits: 8 }, "plate", (shader) =>
      sweepProgram(shader, own, this.#colours),
    );
    const mesh = fix(new Mesh(geometry, material), plate.pose);
    mesh.castShadow = mesh.receiveShadow = true;
    this.#uniforms.push(own);
    this.#materials.push(material);
    this.#meshes.push(mesh);
    this.root.add(mesh);
  }

  setPalette(palette: Palette): void {
    this.#colours.sweptColour.value.set(palette.washed);
    this.#colours.frontColour.value.set(palette.front);
    for (const material of this.#materials) material.color.set(palette.porcelain);
  }

  setCoverage(on: boolean): void {
    this.#on = on;
  }

  /** Shows the coverage as it is at `t` [s], or all of it as heat map. No allocation but where the kind changes. */
  show(t: number, kind: CoverageKind, heat: boolean): void {
    if (kind !== this.#kind) this.#bind(kind);
    const scale = this.#rasters[kind].scale_s;
    for (const own of this.#uniforms) {
      const now = own.sweepNow.value;
      now[0] = t;
      now[1] = heat ? 1 : 0;
      now[2] = this.#on ? 1 : 0;
      now[3] = scale;
    }
  }

  #bind(kind: CoverageKind): void {
    this.#kind = kind;
    const { textures, of } = this.#rasters[kind];
    for (const own of this.#uniforms) own.sweeps.value = this.#empty;
    for (const coverage of of) {
      const own = this.#uniforms[coverage.plate];
      if (own === undefined || !(coverage.half_m > 0)) continue;
      const texture = textures.get(coverage.plate) ?? sweepTexture(coverage);
      textures.set(coverage.plate, texture);
      own.sweeps.value = texture;
      own.sweepFrame.value.set([coverage.half_m, coverage.columns, coverage.rows]);
    }
  }

  dispose(): void {
    for (const { textures } of Object.values(this.#rasters)) for (const texture of textures.values()) texture.dispose();
    this.#colours.heatMap.value.dispose();
    this.#empty.dispose();
  }
}

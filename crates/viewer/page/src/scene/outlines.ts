/** Outlines about the rims of plates: of those that are selected, and of the one that the pointer is over. */
import { Group, Matrix4 } from "three";
import { Lines, stretches } from "./lines.ts";
import type { Palette } from "./palette.ts";
import type { Solid } from "./pick.ts";

export type OutlineKind = "selected" | "hovered";

/** How far outside the rim they are drawn [m]. */
const APART_M = 0.002;

/** A circle about the origin, `segments` chords. */
export function circle(radius_m: number, segments = 128): Float32Array {
  const places = Array.from({ length: segments + 1 }, (_, i) => {
    const angle = (2 * Math.PI * i) / segments;
    return [radius_m * Math.cos(angle), radius_m * Math.sin(angle), 0];
  });
  return stretches([places.flat()]);
}

export class Outlines {
  readonly root = new Group();
  readonly #pools: Record<OutlineKind, Lines[]> = { selected: [], hovered: [] };
  readonly #scale = new Matrix4();
  #palette: Palette | null = null;

  setPalette(palette: Palette): void {
    this.#palette = palette;
    for (const kind of ["selected", "hovered"] as const) for (const lines of this.#pools[kind]) lines.setColour(palette[kind]);
  }

  /** Draws outlines about these plates, and no others of their kind. */
  show(kind: OutlineKind, solids: readonly Solid[]): void {
    const pool = this.#pools[kind];
    while (pool.length < solids.length) pool.push(this.#make(kind));
    pool.forEach((lines, index) => {
      const solid = solids[index];
      lines.visible = solid !== undefined && solid.rim_m > 0;
      if (solid === undefined || !lines.visible) return;
      const size = solid.rim_m + APART_M;
      lines.matrix.copy(solid.pose).multiply(this.#scale.makeScale(size, size, 1).setPosition(0, 0, solid.top_m));
      lines.matrixWorldNeedsUpdate = true;
    });
  }

  #make(kind: OutlineKind): Lines {
    const style = kind === "selected" ? { width: 3.4, before: 4 } : { width: 2.4, opacity: 0.75, before: 4 };
    const lines = new Lines(circle(1), style);
    lines.matrixAutoUpdate = false;
    lines.renderOrder = 3;
    if (this.#palette !== null) lines.setColour(this.#palette[kind]);
    this.root.add(lines);
    return lines;
  }
}

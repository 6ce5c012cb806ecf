/** Ghosts: plates drawn where they could be washed, each tied to its plate by a line. */
import { BufferGeometry, Group, Matrix4, Mesh, type MeshStandardMaterial } from "three";
import type { Centre, Solid } from "./handles.ts";
import { Lines } from "./lines.ts";
import type { Palette } from "./palette.ts";
import { circle } from "./ring.ts";
import type { Studio } from "./stage.ts";

const OPACITY = 0.42;
const HOVERED = 0.7;
/** How far outside the rim the outline is drawn [m]. */
const APART_M = 0.002;
/** How far over the faces the line runs [m]. */
const LIFT_M = 0.004;

export interface GhostPlace {
  plate: number;
  centre_m: Centre;
}

interface Ghost {
  mesh: Mesh<BufferGeometry, MeshStandardMaterial>;
  outline: Lines;
  rim_m: number;
  tie: Lines;
}

export class Ghosts {
  readonly root = new Group();
  readonly #studio: Studio;
  readonly #ghosts: Ghost[] = [];
  #places: GhostPlace[] = [];
  #solids: Solid[] = [];
  #palette: Palette | null = null;

  constructor(studio: Studio) {
    this.#studio = studio;
    // One stays from the start, so that its programs are built before the first is shown.
    this.#ghosts.push(this.#make());
  }

  setPalette(palette: Palette): void {
    this.#palette = palette;
    for (const { mesh, outline, tie } of this.#ghosts) {
      mesh.material.color.set(palette.ghost);
      outline.setColour(palette.ghost);
      tie.setColour(palette.ghost);
    }
  }

  set(places: readonly GhostPlace[]): void {
    this.#places = places.filter(({ centre_m }) => centre_m.every((x) => Math.abs(x) < 50));
  }

  /** Which plate each solid of `solids` is a ghost of. */
  get plates(): number[] {
    return this.#places.map(({ plate }) => plate);
  }

  /** The ghosts as rays meet them. */
  get solids(): readonly Solid[] {
    return this.#solids;
  }

  /** Draws them beside the plates as these lie. */
  show(solids: readonly Solid[], shape: (plate: number) => BufferGeometry | null): void {
    this.#places = this.#places.filter(({ plate }) => solids[plate] !== undefined);
    while (this.#ghosts.length < this.#places.length) this.#ghosts.push(this.#make());
    this.#solids = this.#places.map(({ plate, centre_m: [x, y] }) => {
      const solid = solids[plate]!;
      const pose = solid.pose.clone();
      pose.elements[12] = x;
      pose.elements[13] = y;
      return { ...solid, pose };
    });
    this.#ghosts.forEach((ghost, index) => {
      const place = this.#places[index];
      const shown = place !== undefined;
      // Programs depend on what triangles come with, so that hidden ghosts have them, too.
      ghost.mesh.geometry = shape(place?.plate ?? 0) ?? ghost.mesh.geometry;
      ghost.mesh.visible = ghost.outline.visible = ghost.tie.visible = shown;
      if (!shown) return;
      this.#place(ghost, solids[place.plate]!, this.#solids[index]!);
    });
  }

  #place(ghost: Ghost, from: Solid, to: Solid): void {
    ghost.mesh.matrix.copy(to.pose);
    if (to.rim_m !== ghost.rim_m && to.rim_m > 0) ghost.outline.setEnds(circle(to.rim_m + APART_M));
    ghost.rim_m = to.rim_m;
    ghost.outline.matrix.copy(to.pose).multiply(new Matrix4().makeTranslation(0, 0, to.top_m));
    const place = ({ pose, top_m }: Solid): number[] => [pose.elements[12]!, pose.elements[13]!, pose.elements[14]! + top_m + LIFT_M];
    ghost.tie.moveFirst(place(from), place(to));
    for (const object of [ghost.mesh, ghost.outline]) object.matrixWorldNeedsUpdate = true;
  }

  /** Brings out the ghost of a plate, or none. */
  hover(plate: number | null): void {
    this.#ghosts.forEach(({ mesh, outline }, index) => {
      const opacity = plate !== null && this.#places[index]?.plate === plate ? HOVERED : OPACITY;
      mesh.material.opacity = opacity;
      outline.setWidth(opacity === HOVERED ? 4 : 2.6);
    });
  }

  #make(): Ghost {
    const material = this.#studio.material({ roughness: 0.4, transparent: true, opacity: OPACITY, depthWrite: false });
    const mesh = new Mesh<BufferGeometry, MeshStandardMaterial>(new BufferGeometry(), material);
    const outline = new Lines(circle(1), { width: 2.6, dash_m: [0.018, 0.012], before: 2 });
    const tie = new Lines(new Float32Array(6).fill(1), { width: 1.6, opacity: 0.85 });
    tie.frustumCulled = false;
    mesh.renderOrder = 4;
    outline.renderOrder = tie.renderOrder = 5;
    for (const object of [mesh, outline]) object.matrixAutoUpdate = false;
    for (const object of [mesh, outline, tie]) object.visible = false;
    this.root.add(mesh, outline, tie);
    if (this.#palette !== null) {
      material.color.set(this.#palette.ghost);
      for (const lines of [outline, tie]) lines.setColour(this.#palette.ghost);
    }
    return { mesh, outline, rim_m: 1, tie };
  }
}

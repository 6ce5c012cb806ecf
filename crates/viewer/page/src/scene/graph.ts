/** What hangs in three's scene graph: poses of the document, and what was replaced. */
import { Material, type Object3D, type WebGLRenderer } from "three";
import { matrixOf } from "../motion.ts";
import type { Pose } from "../view.ts";

/** Fixes an object to its parent at `T_parent_object`. */
export function fix<T extends Object3D>(object: T, pose: Pose): T {
  object.matrixAutoUpdate = false;
  object.matrix.copy(matrixOf(pose));
  object.matrixWorldNeedsUpdate = true;
  return object;
}

interface Program {
  usedTimes: number;
}

/**
 * What was replaced, freed once its successors have been drawn: till then they find the programs of the graphics processor that they
 * share, and none is built again. The last user of a program stays for the next one that wants it.
 */
export class Retired {
  readonly #renderer: WebGLRenderer;
  readonly #waiting = new Set<Material>();
  /** At most one a program. */
  readonly #keepers = new Map<Program, Material>();

  constructor(renderer: WebGLRenderer) {
    this.#renderer = renderer;
  }

  /** Takes an object from the scene, with all below it. */
  add(root: Object3D): void {
    root.removeFromParent();
    root.traverse((object) => {
      const parts = object as { geometry?: { dispose(): void }; material?: Material | Material[] };
      parts.geometry?.dispose();
      for (const material of [parts.material ?? []].flat()) this.addMaterial(material);
    });
  }

  addMaterial(material: Material): void {
    this.#waiting.add(material);
  }

  /** After drawing: frees what waits, but for the last user of each program. */
  free(): void {
    for (const material of this.#waiting) {
      const programs = this.#programsOf(material);
      const last = programs.filter((program) => program.usedTimes <= 1);
      if (last.length === 0) material.dispose();
      else for (const program of last) this.#keepers.set(program, material);
    }
    this.#waiting.clear();
    for (const [program, keeper] of this.#keepers) {
      const others = this.#programsOf(keeper).every((one) => one.usedTimes > 1);
      if (!others) continue;
      this.#keepers.delete(program);
      keeper.dispose();
    }
  }

  #programsOf(material: Material): Program[] {
    const found = (this.#renderer.properties.get(material) as { programs?: Map<string, Program> }).programs;
    return found === undefined ? [] : [...found.values()];
  }
}

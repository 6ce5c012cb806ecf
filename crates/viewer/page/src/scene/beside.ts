/** The cell once more, beside the plan's: what another program makes of the same arm and plates, on the same clock. */
import { Group, Vector3 } from "three";
import { decodeCoverage } from "../coverage.ts";
import { AXES } from "../motion.ts";
import { Recording } from "../recording.ts";
import type { Beside, View } from "../view.ts";
import { ArmGraph } from "./arm.ts";
import type { Retired } from "./graph.ts";
import type { Palette } from "./palette.ts";
import { Plates } from "./plates.ts";
import type { Studio } from "./stage.ts";
import type { Extent } from "./views.ts";

/** Between the two cells [m]. */
const GAP_M = 0.1;
/** Where the overview sees the right, before it is turned. */
const RIGHT = new Vector3(0.82, 1, 0).normalize();

export class BesideCell {
  readonly root = new Group();
  /** What the picture of both cells has to hold. */
  readonly extent: Extent;
  readonly #arm: ArmGraph;
  readonly #plates: Plates;
  readonly #motion: Recording;
  readonly #q = new Float64Array(AXES);

  constructor(view: View, beside: Beside, extent: Extent, studio: Studio, retired: Retired) {
    this.#arm = new ArmGraph(view.arm, studio);
    this.#plates = new Plates(studio, retired);
    this.#plates.replace(view.plates);
    this.#plates.cover("executed", beside.coverage.map(decodeCoverage));
    // Without a dose that is proved, no dirt goes.
    const dirt = view.dirt.map((one) => ({ ...one, clean: { shape: [1, 1], u16: "//8=" } }));
    this.#plates.lay(dirt);
    this.#motion = new Recording({ ...beside, torque_n_m: null, error_m: null });
    this.root.add(this.#arm.root, this.#plates.root);
    const { box } = extent;
    const right = RIGHT.clone().applyAxisAngle(new Vector3(0, 0, 1), extent.facing);
    const places = extent.points.map((point) => point.dot(right));
    this.root.position.copy(right).multiplyScalar(Math.max(...places) - Math.min(...places) + GAP_M);
    const points = [...extent.points, ...extent.points.map((point) => point.clone().add(this.root.position))];
    const both = box.clone().union(box.clone().translate(this.root.position));
    this.extent = { points, box: both, sphere: both.getBoundingSphere(extent.sphere.clone()), facing: extent.facing };
  }

  setPalette(palette: Palette): void {
    this.#plates.setPalette(palette);
  }

  /** Moves it to a time [s]. */
  show(t: number): void {
    if (this.#motion.positionAt(t, this.#q)) this.#arm.set(this.#q);
    this.#plates.show(t, "executed", false);
  }
}

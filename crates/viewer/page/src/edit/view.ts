/** What the page shows of a live cell: the document of a plan that is, is not yet, or cannot be. */
import type { View } from "../view.ts";
import type { CellDrawn, PlanLine, ProofLine } from "./answers.ts";

/** Makes views out of answers. The same answers give the same view, and the same arm the same object. */
export class ViewMaker {
  readonly #version: string;
  #arm: View["arm"];
  #made: { cell: CellDrawn; plan: PlanLine | null; proof: ProofLine | null; view: View } | null = null;

  /** `first`: what the page came with. */
  constructor(first: View) {
    this.#version = first.version;
    this.#arm = first.arm;
  }

  /** The cell, with its plan and proof as far as there are. */
  of(cell: CellDrawn, arm: CellDrawn["arm"], plan: PlanLine | null, proof: ProofLine | null): View {
    const made = this.#made;
    if (made !== null && made.cell === cell && made.plan === plan && made.proof === proof) return made.view;
    if (arm !== null && arm.id === cell.arm_id) this.#arm = arm.arm;
    const view: View = {
      format: "platewash-view/1",
      version: this.#version,
      heading: plan?.heading ?? cell.heading,
      certificate: proof?.certificate ?? null,
      arm: this.#arm,
      tool: cell.tool,
      surroundings: cell.surroundings,
      plates: cell.plates,
      paths: plan?.paths ?? NONE,
      segments: plan?.segments ?? NONE,
      motion: plan?.motion ?? null,
      pose_rad: cell.pose_rad,
      clearance: plan?.clearance ?? null,
      coverage: (plan?.coverage ?? []).map((one) => withProof(one, proof)),
      execution: null,
      live: null,
    };
    this.#made = { cell, plan, proof, view };
    return view;
  }
}

/** The same object each time, for those who ask what is different. */
const NONE: never[] = [];

function withProof(coverage: View["coverage"][number], proof: ProofLine | null): View["coverage"][number] {
  const proved = proof?.proved.find(({ plate }) => plate === coverage.plate)?.at_least;
  return proved === undefined ? coverage : { ...coverage, proved };
}

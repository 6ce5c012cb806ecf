/** What has been said about one version of the scenario. */
import type { CellLine } from "./protocol.ts";

type Of<K extends CellLine["kind"]> = Extract<CellLine, { kind: K }>;

export type ScenarioLine = Of<"scenario">;
export type RefusedLine = Of<"refused">;
export type CellDrawn = Of<"cell">;
export type PreviewLine = Of<"preview">;
export type PlanLine = Of<"plan">;
export type UnplannedLine = Of<"unplanned">;
export type PlaceLine = Of<"place">;
export type ProofLine = Of<"proof">;

export interface Answers {
  scenario: ScenarioLine | null;
  refused: RefusedLine | null;
  cell: CellDrawn | null;
  preview: PreviewLine | null;
  plan: PlanLine | null;
  unplanned: UnplannedLine | null;
  places: readonly PlaceLine[];
  proof: ProofLine | null;
  failed: string | null;
}

export const NOTHING: Answers = {
  scenario: null,
  refused: null,
  cell: null,
  preview: null,
  plan: null,
  unplanned: null,
  places: [],
  proof: null,
  failed: null,
};

/** Whether something is a line of an answer to `/cell`. */
export function isLine(line: unknown): line is CellLine {
  return typeof line === "object" && line !== null && typeof (line as { kind?: unknown }).kind === "string";
}

/** What is known with one more line. Lines of a later version of the protocol are left out. */
export function withLine(answers: Answers, line: CellLine): Answers {
  switch (line.kind) {
    case "scenario":
    case "refused":
    case "cell":
    case "preview":
    case "plan":
    case "unplanned":
    case "proof":
      return { ...answers, [line.kind]: line };
    case "place":
      return { ...answers, places: [...answers.places, line] };
    case "failed":
      return { ...answers, failed: line.words };
    default:
      return answers;
  }
}

/** Whether nothing has to follow. */
export function isWhole(answers: Answers, want: "preview" | "proof"): boolean {
  if (answers.refused !== null || answers.failed !== null) return true;
  if (want === "preview") return answers.preview !== null;
  return answers.unplanned !== null || answers.proof !== null;
}

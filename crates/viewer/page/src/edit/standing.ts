/** How a live cell stands, in words. */
import type { Answers, PreviewLine } from "./answers.ts";

export type Activity = "idle" | "previewing" | "planning" | "proving";

export interface Standing {
  kind: "preview" | "planned" | "proved" | "not proved" | "unplanned" | "refused" | "lost" | "failed";
  /** A sentence. */
  words: string;
}

/** What a question's answers so far come to. */
export function standing(answers: Answers): Standing {
  const { failed, refused, proof, unplanned, plan } = answers;
  if (failed !== null) return { kind: "failed", words: failed };
  if (refused !== null) return { kind: "refused", words: refused.words };
  if (proof !== null) return { kind: proof.certificate.passes ? "proved" : "not proved", words: proof.headline };
  if (unplanned !== null) return { kind: "unplanned", words: unplanned.headline };
  if (plan !== null) return { kind: "planned", words: plan.headline };
  return { kind: "preview", words: answers.preview === null ? "Being looked at …" : previewWords(answers.preview, answers) };
}

function previewWords(preview: PreviewLine, { cell }: Answers): string {
  const names = (chance: string): string[] =>
    preview.plates.filter((one) => one.chance === chance).map(({ plate }) => cell?.plates[plate]?.name ?? `plate ${plate}`);
  const [no, open] = [names("unwashable"), names("unclear")];
  if (no.length > 0) return `A guess before planning: ${listed(no)} may not be washable there.`;
  if (open.length > 0) return `A guess before planning: whether ${listed(open)} can be washed is unclear.`;
  return "A guess before planning: every plate can be washed.";
}

function listed(names: readonly string[]): string {
  const most = 4;
  return names.length <= most ? names.join(", ") : `${names.slice(0, most).join(", ")} and ${names.length - most} more`;
}

/** How far a question that runs has come. */
export function activity(answers: Answers): Activity {
  if (answers.plan !== null) return "proving";
  return answers.preview === null && answers.cell === null ? "previewing" : "planning";
}

/** What has been said about a scenario, and what that comes to: for the cell, for the head of the page, for each plate. */
import { percentDown, plateName } from "../format.ts";
import { verdict as proved, type Tone, type Verdict } from "../verdict.ts";
import type { View } from "../view.ts";
import type { CellLine } from "./protocol.ts";

type Of<K extends CellLine["kind"]> = Extract<CellLine, { kind: K }>;

export type CellDrawn = Of<"cell">;
export type PlanLine = Of<"plan">;
export type ProofLine = Of<"proof">;

/** What has been said about one version of the scenario. */
export type Answers = { [K in "scenario" | "refused" | "cell" | "preview" | "plan" | "unplanned" | "proof"]: Of<K> | null } & {
  places: readonly Of<"place">[];
  failed: string | null;
};

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
  if (line.kind === "place") return { ...answers, places: [...answers.places, line] };
  if (line.kind === "failed") return { ...answers, failed: line.words };
  return line.kind in answers ? { ...answers, [line.kind]: line } : answers;
}

/** Whether nothing has to follow. */
export function isWhole(answers: Answers, want: "preview" | "proof"): boolean {
  if (answers.refused !== null || answers.failed !== null) return true;
  if (want === "preview") return answers.preview !== null;
  return answers.unplanned !== null || answers.proof !== null;
}

/** What is shown of a scenario whatever is asked: the newest that was said of it, until something newer is. */
export class Seen {
  /** What keys state and what counts. */
  scenario: Answers["scenario"] = null;
  /** Plates, tool and surroundings, planned or not. Its arm is in `arm`. */
  drawn: CellDrawn | null = null;
  arm: CellDrawn["arm"] = null;
  /** Null where more is known than a guess. */
  preview: Answers["preview"] = null;

  /** `counts`: the line is about the version that counts, and not of a moment ago. */
  hear(line: CellLine, counts: boolean): void {
    if (line.kind === "scenario") this.scenario = line;
    else if (line.kind === "preview") this.preview = line;
    else if (line.kind === "cell") this.#draw(line);
    else if (counts) this.preview = null;
  }

  /** Goes back to what was said before. */
  restore(answers: Answers): void {
    this.scenario = answers.scenario ?? this.scenario;
    this.preview = answers.plan === null && answers.unplanned === null ? answers.preview : null;
    if (answers.cell !== null) this.#draw(answers.cell);
  }

  #draw(line: CellDrawn): void {
    this.drawn = line;
    this.arm = line.arm ?? this.arm;
  }
}

export type Activity = "idle" | "previewing" | "planning" | "proving";

/** How a live cell stands. */
export interface Standing {
  kind: "preview" | "planned" | "proved" | "not proved" | "unplanned" | "refused" | "lost" | "failed";
  /** A sentence. */
  words: string;
}

/** What a question's answers so far come to. */
export function standing(answers: Answers): Standing {
  const { failed, refused, proof, unplanned, plan } = answers;
  if (failed !== null) return { kind: "failed", words: failed };
  if (refused !== null) return { kind: "refused", words: refused.line === null ? refused.words : `line ${refused.line}: ${refused.words}` };
  if (proof !== null) return { kind: proof.certificate.passes ? "proved" : "not proved", words: proof.headline };
  if (unplanned !== null) return { kind: "unplanned", words: unplanned.headline };
  if (plan !== null) return { kind: "planned", words: plan.headline };
  return { kind: "preview", words: answers.preview === null ? "Being looked at …" : previewWords(answers.preview, answers) };
}

function previewWords(preview: Of<"preview">, { cell }: Answers): string {
  const names = (chance: string): string[] =>
    preview.plates.filter((one) => one.chance === chance).map(({ plate }) => plateName(cell?.plates, plate));
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

/** What is said while something is being typed. */
export const NOT_APPLIED: Verdict = { tone: "none", word: "Not applied", sentence: "What is typed is not applied yet. Press Enter, or Ctrl+Enter in the text; Escape gives it up." };

/** Whether there is a change that no plan has, and none is on its way. */
export function isStale({ kind }: Standing): boolean {
  return kind === "refused" || kind === "unplanned" || kind === "failed" || kind === "lost";
}

/** Bodies among those that stand around that the reason for no plan names, or that a refused key is of. */
export function blamedBodies({ refused, unplanned }: Answers, { surroundings, moves }: CellDrawn): number[] {
  const words = [refused?.words ?? "", unplanned?.headline ?? "", ...(unplanned?.plates.flatMap(({ words, causes }) => [words, ...causes]) ?? [])].join("\n");
  const section = /^obstacle\[\d+\]/.exec(refused?.key ?? "")?.[0];
  return surroundings.obstacles.flatMap(({ name }, body) => {
    const isOf = section !== undefined && moves.bodies[body]?.key?.startsWith(`${section}.`) === true;
    return isOf || names(words, name) ? [body] : [];
  });
}

/** Whether words name a thing, and not one whose name is longer. */
function names(words: string, name: string): boolean {
  const isPart = (letter: string | undefined): boolean => letter !== undefined && /\w/.test(letter);
  for (let at = words.indexOf(name); name !== "" && at >= 0; at = words.indexOf(name, at + 1)) {
    if (!isPart(words[at - 1]) && !isPart(words[at + name.length])) return true;
  }
  return false;
}

/** Never better than what was answered; a proof speaks for itself. */
export function editVerdict({ kind, words }: Standing, answers: Answers, view: View): Verdict {
  switch (kind) {
    case "proved":
    case "not proved":
      return proved({ ...view, certificate: answers.proof?.certificate ?? null });
    case "planned":
      return { tone: "not_proved", word: "Planned, not proved", sentence: words };
    case "preview":
      return { tone: "none", word: "Preview", sentence: words };
    case "unplanned":
      return unplannedVerdict(answers, words);
    case "refused":
      return { tone: "violated", word: "Refused", sentence: `${words.replace(/[.!?]?$/, ".")}${view.motion === null ? "" : " The plan of before is shown in grey."}` };
    case "lost":
      return { tone: "not_proved", word: "Connection lost", sentence: words };
    case "failed":
      return { tone: "violated", word: "Failed", sentence: words };
  }
}

/** Plates by name where some are to blame, whose rows give the reasons; otherwise the reason. */
function unplannedVerdict({ unplanned, cell }: Answers, words: string): Verdict {
  const known = unplanned?.proved === true;
  const all = unplanned?.plates ?? [];
  // Only plates that are known to be at fault are said to be so.
  const blamed = known ? all.filter(({ proved }) => proved) : all;
  const plates = blamed.map(({ plate }) => plateName(cell?.plates, plate));
  const tone = known ? "violated" : "not_proved";
  if (plates.length === 0) return { tone, word: known ? "Cannot be planned" : "No plan found", sentence: words.replace(/^[A-Z ]+: /, "") };
  const sentence = known ? `${listed(plates)} cannot be washed there.` : `no way was found to wash ${listed(plates)}.`;
  return { tone, word: known ? "Cannot be washed" : "No plan found", sentence };
}

/** What is known of a plate, in a word and a tone. */
export interface PlateState {
  tone: Tone;
  word: string;
  /** Why it cannot be washed; empty where there is nothing to say. */
  words: string;
  causes: readonly string[];
  /** Where else it could lie [m]; null for nowhere near, undefined where nobody has looked. */
  nearest_m: [number, number] | null | undefined;
  /** How far around was looked [m]. */
  searched_m: number;
}

const OPEN: PlateState = { tone: "none", word: "Being looked at", words: "", causes: [], nearest_m: undefined, searched_m: 0 };

export function plateState(answers: Answers, plate: number): PlateState {
  const { unplanned, places, proof, plan, preview, refused, failed } = answers;
  if (refused !== null || failed !== null) return { ...OPEN, tone: "not_proved", word: "Not planned" };
  if (unplanned !== null) {
    const one = unplanned.plates.find((row) => row.plate === plate);
    if (one === undefined) return { ...OPEN, tone: "not_proved", word: "Not planned" };
    const place = places.find((row) => row.plate === plate);
    return {
      tone: one.proved ? "violated" : "not_proved",
      word: one.proved ? "Cannot be washed" : "No way found",
      words: one.words,
      causes: one.causes,
      nearest_m: place?.nearest_m,
      searched_m: place?.searched_m ?? 0,
    };
  }
  if (proof !== null) {
    const share = proof.proved.find((row) => row.plate === plate)?.at_least;
    const word = share === undefined ? "Washed" : `${proof.certificate.contact === null ? "Swept" : "Pressed"} ≥\u202f${percentDown(share)}`;
    const waived = proof.certificate.checks.some(({ status }) => status === "waived");
    if (waived && proof.certificate.passes) return { ...OPEN, tone: "not_proved", word: `${word}, with a waiver` };
    return proof.certificate.passes ? { ...OPEN, tone: "proved", word } : { ...OPEN, tone: "not_proved", word: "Planned, not proved" };
  }
  if (plan !== null) return { ...OPEN, word: "Planned" };
  const guess = preview?.plates.find((row) => row.plate === plate);
  switch (guess?.chance) {
    case "washable":
      return { ...OPEN, word: "Looks washable", words: guess.words };
    case "unwashable":
      return { ...OPEN, tone: "not_proved", word: "Looks unwashable", words: guess.words };
    case "unclear":
      return { ...OPEN, tone: "not_proved", word: "Unclear", words: guess.words };
    default:
      return OPEN;
  }
}

/** What is known of each plate, in a word and a tone. */
import { percentDown } from "../format.ts";
import type { Tone } from "../verdict.ts";
import type { Answers } from "./answers.ts";

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
  const { unplanned, places, proof, plan, preview } = answers;
  if (unplanned !== null) {
    const one = unplanned.plates.find((row) => row.plate === plate);
    if (one === undefined) return { ...OPEN, word: "Waits for another plate" };
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

/** What may be said of a plan at first glance. */
import { counted } from "./format.ts";
import type { Certificate, Status, View } from "./view.ts";

/** How a verdict looks: `none` is no verdict, neither good nor bad. */
export type Tone = Status | "none";

export interface Verdict {
  tone: Tone;
  /** On the badge. */
  word: string;
  /** A sentence. */
  sentence: string;
}

const WORDS: Record<Status, string> = { proved: "Proved", violated: "Violated", not_proved: "Not proved", waived: "Waived" };

/** The verdict at the beginning of a headline, which the badge says. */
export const VERDICT = /^(NOT )?PROVED[^:]*: /;

/** The worst status first. */
export const RANK: Record<Status, number> = { violated: 0, not_proved: 1, waived: 2, proved: 3 };

/** A status in words. */
export function statusWord(status: Status): string {
  return WORDS[status];
}

export function countOf(certificate: Certificate, status: Status): number {
  return certificate.checks.filter((check) => check.status === status).length;
}

/**
 * Never better than the certificate's own word: a plan whose hash does not fit, or with a requirement that is not kept, is not proved.
 * A dry run says first that it is one, so that nobody takes it for a washing.
 */
export function verdict(view: View): Verdict {
  const judged = ofMotion(view);
  const words = view.heading.dry_run;
  if (words === null) return judged;
  const sentence = judged.sentence.startsWith(words) ? judged.sentence : `${words}; ${judged.sentence}`;
  return { ...judged, word: `Dry run: ${judged.word.toLowerCase()}`, sentence };
}

function ofMotion(view: View): Verdict {
  const certificate = view.certificate;
  if (certificate === null) return { tone: "none", word: "No certificate", sentence: withoutCertificate(view) };
  const sentence = certificate.headline;
  const violated = countOf(certificate, "violated");
  if (certificate.hash !== "proved") return { tone: "violated", word: "Altered", sentence };
  if (violated > 0) return { tone: "violated", word: "Violated", sentence };
  if (!certificate.passes || countOf(certificate, "not_proved") > 0) return { tone: "not_proved", word: "Not proved", sentence };
  const waived = countOf(certificate, "waived");
  if (waived > 0) return { tone: "waived", word: `Proved but for ${waived} waived`, sentence };
  return { tone: "proved", word: "Proved", sentence };
}

function withoutCertificate(view: View): string {
  switch (view.heading.process) {
    case "paper":
      return "No certificate: the paper’s program is judged by what is measured on its motion.";
    case null:
      return "No certificate: one configuration, not a motion.";
    case "wash":
      return "No certificate: nothing was proved about this plan.";
  }
}

/** What came of carrying it out; null where nothing is known of it, and in a dry run, which washes nothing. */
export function washed(view: View): Verdict | null {
  const execution = view.execution;
  if (execution === null || execution.washed === null || view.heading.dry_run !== null) return null;
  const sentence = execution.headline ?? "";
  const how = { simulated: "simulated", recorded: "recorded", live: "simulated" }[execution.source];
  const done = view.heading.treatment === "washed" ? "washed" : "swept";
  return execution.washed
    ? { tone: "proved", word: `${done === "washed" ? "Washed" : "Swept"}, ${how}`, sentence }
    : { tone: "violated", word: `Not ${done}, ${how}`, sentence };
}

const ASSUMED = "assumed: ";

/** Whether a line of what a proof rests on is an assumption. */
export function isAssumed(line: string): boolean {
  return line.startsWith(ASSUMED);
}

/** What a proof assumes. */
export function assumptions(certificate: Certificate | null): string[] {
  return (certificate?.rests_on ?? []).filter(isAssumed).map((line) => line.slice(ASSUMED.length));
}

/** The certificate's requirements in figures: “24 proved, 1 violated”. */
export function summary(certificate: Certificate): string {
  const parts = (["violated", "not_proved", "waived", "proved"] as const)
    .map((status) => ({ status, count: countOf(certificate, status) }))
    .filter(({ count }) => count > 0)
    .map(({ status, count }) => `${count} ${WORDS[status].toLowerCase()}`);
  return `${counted(certificate.checks.length, "requirement")}: ${parts.join(", ")}`;
}

/** Files to take home: the scenario, and what the command would write of it. */
import type { Channel } from "../edit/channel.ts";

/** Files of a planned and proved cell, by what the engine calls them. */
export const FILES = {
  "plan.json": "Plan (plan.json)",
  "certificate.json": "Certificate (certificate.json)",
  "page.html": "Page (page.html)",
  rapid: "RAPID program",
  ros2: "ROS 2 trajectory",
  urscript: "URScript program",
  csv: "Robot’s points as CSV",
} as const;

export type FileKind = keyof typeof FILES;

interface NamedText {
  name: string;
  text: string;
}

/** A line of the answer: a file, or why there is none. */
type FileLine = ({ kind: "file" } & NamedText) | { kind: "failed"; words: string };

/** The parts that all pages share, which the folder has beside this page. */
async function bundle(): Promise<Record<string, string>> {
  const names = { template: "index.html", style: "page.css", script: "page.js", notices: "notices.txt" };
  const texts = Object.entries(names).map(async ([part, name]) => {
    const answer = await fetch(`page/${name}`);
    if (!answer.ok) throw new Error(`the server answers ${answer.status} for page/${name}`);
    return [part, await answer.text()];
  });
  return Object.fromEntries(await Promise.all(texts)) as Record<string, string>;
}

/** The files of a kind, as the engine makes them of a scenario. An `Error` says why there are none. */
export async function filesOf(channel: Channel, text: string, file: FileKind): Promise<NamedText[]> {
  const question = { text, file, bundle: file === "page.html" ? await bundle() : null };
  const files: NamedText[] = [];
  let words = "";
  await channel.ask("/file", question, (line) => {
    const told = line as FileLine;
    if (told.kind === "file") files.push(told);
    else words = told.words;
  }, new AbortController().signal);
  if (words !== "" || files.length === 0) throw new Error(words === "" ? "the engine gave no file" : words);
  return files;
}

/** Hands a file to the browser, which saves it among the user's downloads. */
export function download({ name, text }: NamedText): void {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(new Blob([text]));
  link.download = name;
  link.click();
  // The browser has begun to read it by then.
  setTimeout(() => URL.revokeObjectURL(link.href), 60_000);
}

/** Name of a scenario's file: the name that its text states, as far as a file can have it. */
export function scenarioFile(text: string): string {
  const head = text.split(/^\s*\[/m, 1)[0]!;
  const name = /^\s*name\s*=\s*["']([^"'\n]*)["']/m.exec(head)?.[1] ?? "";
  const plain = name.replace(/[^\p{L}\p{N}_.-]+/gu, "-").replace(/^[-.]+|[-.]+$/g, "").slice(0, 80);
  return `${plain === "" ? "scenario" : plain}.toml`;
}

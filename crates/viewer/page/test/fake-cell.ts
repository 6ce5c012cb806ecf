/** A cell in the hands of a test: whoever plans answers when told to, and time passes when told to. */
import { Cell } from "../src/edit/cell.ts";
import type { Centre } from "../src/scene/handles.ts";
import { ChannelError, type Channel } from "../src/edit/channel.ts";
import type { CellQuestion } from "../src/edit/protocol.ts";
import type { Time } from "../src/edit/asker.ts";

export class FakeTime implements Time {
  #now = 0;
  #timers: { at: number; callback: () => void }[] = [];

  now(): number {
    return this.#now;
  }

  later(callback: () => void, after_ms: number): () => void {
    const timer = { at: this.#now + after_ms, callback };
    this.#timers.push(timer);
    return () => {
      this.#timers = this.#timers.filter((one) => one !== timer);
    };
  }

  pass(ms: number): void {
    this.#now += ms;
    const due = this.#timers.filter(({ at }) => at <= this.#now);
    this.#timers = this.#timers.filter(({ at }) => at > this.#now);
    for (const { callback } of due) callback();
  }
}

export class Asking {
  readonly path: string;
  readonly question: CellQuestion;
  readonly signal: AbortSignal;
  readonly #onLine: (line: unknown) => void;
  readonly #end: (error: Error | null) => void;

  constructor(path: string, question: CellQuestion, signal: AbortSignal, onLine: (line: unknown) => void, end: (error: Error | null) => void) {
    this.path = path;
    this.question = question;
    this.signal = signal;
    this.#onLine = onLine;
    this.#end = end;
  }

  say(...lines: object[]): void {
    for (const line of lines) this.#onLine(line);
  }

  /** The stream ends; what waits for it gets its turn. */
  async end(error: Error | null = null): Promise<void> {
    this.#end(error);
    await turns();
  }

  /** The scenario and the cell, with changes written as a toy would. */
  drawn(text = written(this.question)): void {
    this.say({ kind: "scenario", text, stated: {}, values: {}, ms: { edit: 1 } }, { ...CELL, centres_m: centresOf(this.question) });
  }

  async proved(): Promise<void> {
    this.drawn();
    this.say(PLAN, PROOF);
    await this.end();
  }
}

export const CELL = { kind: "cell", arm: null, arm_id: "a", plates: [{ name: "plate 1" }, { name: "plate 2" }], surroundings: { obstacles: [], base_circle_m: null, polygon_m: null }, listed: false, findings: [], ms: {} };
export const PLAN = { kind: "plan", headline: "planned", ms: { plan: 5 } };
export const PROOF = { kind: "proof", headline: "PROVED", certificate: { passes: true }, proved: [], ms: {} };
export const PREVIEW = { kind: "preview", plates: [{ plate: 1, chance: "unwashable", words: "" }], ms: {} };

export function centresOf(question: CellQuestion): Centre[] {
  const edit = question.edits.find(({ key }) => key === "layout.positions_m");
  return (edit?.value as unknown as Centre[] | undefined) ?? [[0.1, 0], [0.4, 0]];
}

/** A text that has the changes in it. */
export function written(question: CellQuestion): string {
  return question.edits.reduce((text, { key, value }) => {
    const kept = text.split("\n").filter((line) => !line.startsWith(`${key} = `));
    return [...kept, ...(value === null ? [] : [`${key} = ${JSON.stringify(value)}`])].join("\n");
  }, question.text);
}

export async function turns(): Promise<void> {
  for (let k = 0; k < 6; k++) await Promise.resolve();
}

export class FakeChannel implements Channel {
  readonly asked: Asking[] = [];

  ask(path: string, question: object, onLine: (line: unknown) => void, signal: AbortSignal): Promise<void> {
    return new Promise((resolve, reject) => {
      const end = (error: Error | null): void => (error === null ? resolve() : reject(error));
      this.asked.push(new Asking(path, question as CellQuestion, signal, onLine, end));
    });
  }

  /** The last question of a kind. */
  last(want: "preview" | "proof"): Asking {
    const found = this.asked.findLast(({ question }) => question.want === want);
    if (found === undefined) throw new Error(`nobody asked for ${want}`);
    return found;
  }

  count(want: "preview" | "proof"): number {
    return this.asked.filter(({ question }) => question.want === want).length;
  }
}

export const LOST = new ChannelError("lost", "The connection to platewash is lost.");

export function newCell(text = "name = \"a\""): { cell: Cell; channel: FakeChannel; time: FakeTime; changes: () => number } {
  const [channel, time] = [new FakeChannel(), new FakeTime()];
  let changes = 0;
  const steps = [{ version: { text, edits: [] }, label: "" }];
  const cell = new Cell({ channel, time, session: "s", steps, at: 0, onChange: () => changes++ });
  return { cell, channel, time, changes: () => changes };
}

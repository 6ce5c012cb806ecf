/** The way on after a stop of the cell's plan, asked on request and shown in place of the plan. */
import type { View } from "../view.ts";
import type { Channel } from "./channel.ts";
import type { RecoveryLine, RecoveryQuestion } from "./protocol.ts";
import { SideAsker } from "./side.ts";

/** Numbers of a text: six joint positions [deg]; null for an empty text. */
export function readJoints(text: string): number[] | null | "not six" {
  const words = text.split(/[\s,;°]+/).filter((word) => word !== "");
  if (words.length === 0) return null;
  const numbers = words.map(Number);
  return numbers.length === 6 && numbers.every(Number.isFinite) ? numbers : "not six";
}

export class RecoveryAsker extends SideAsker<RecoveryQuestion, RecoveryLine> {
  #view: View | null = null;

  constructor(channel: Channel, session: string, changed: () => void) {
    super(channel, `${session}r`, changed);
  }

  /** The motion home, where there is one. */
  get view(): View | null {
    return this.#view;
  }

  /** Asks for the way on from where the arm stands, or from where the plan has it at that time. */
  ask(text: string, stopped_s: number | null, at_deg: number[] | null): void {
    this.question("/recover", text, { stopped_s, at_deg }, "Planning and proving the way home …", "The recovery cannot be read.");
  }

  /** Says why nothing is asked. */
  refuse(text: string, words: string): void {
    this.clear();
    this.begin(text, words);
  }

  protected hear(line: RecoveryLine): void {
    switch (line.kind) {
      case "recovery": {
        const rest = line.rest === null ? "All plates were washed." : `Then the rest: ${line.rest}.`;
        this.#view = line.view;
        return this.say(`Stopped ${line.stop}. Shown: the motion home. ${rest}`);
      }
      case "refused":
      case "failed":
        return this.say(line.words);
      default:
    }
  }

  protected forget(): void {
    this.#view = null;
  }
}

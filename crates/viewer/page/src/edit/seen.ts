/** What is shown of a scenario whatever is asked: the newest that was said of it, until something newer is. */
import type { Answers, CellDrawn, PreviewLine, ScenarioLine } from "./answers.ts";
import type { CellLine } from "./protocol.ts";

export class Seen {
  /** What keys state and what counts. */
  scenario: ScenarioLine | null = null;
  /** Plates, tool and surroundings, planned or not. Its arm is in `arm`. */
  drawn: CellDrawn | null = null;
  arm: CellDrawn["arm"] = null;
  /** Null where more is known than a guess. */
  preview: PreviewLine | null = null;

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

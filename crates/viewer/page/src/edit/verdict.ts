/** How a live cell's standing looks at the head of the page. */
import { verdict as proved, type Verdict } from "../verdict.ts";
import type { View } from "../view.ts";
import type { Answers } from "./answers.ts";
import type { Standing } from "./standing.ts";

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
      return answers.unplanned?.proved === true
        ? { tone: "violated", word: "Cannot be washed", sentence: words }
        : { tone: "not_proved", word: "No plan found", sentence: words };
    case "refused":
      return { tone: "violated", word: "Refused", sentence: `${words.replace(/[.!?]?$/, ".")} What is shown is of before.` };
    case "lost":
      return { tone: "not_proved", word: "Connection lost", sentence: words };
    case "failed":
      return { tone: "violated", word: "Failed", sentence: words };
  }
}

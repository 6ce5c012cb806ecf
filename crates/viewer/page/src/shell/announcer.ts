/** What screen readers are told: few words, not every frame. */
import { byId } from "./dom.ts";

export function announce(words: string): void {
  byId("announcer").textContent = words;
}

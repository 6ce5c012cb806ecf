/** Where a plate could be washed, asked on request and shown as it comes. */
import type { Editing } from "../scene/editing.ts";
import type { Channel } from "./channel.ts";
import type { MapLine, MapQuestion } from "./protocol.ts";
import { SideAsker } from "./side.ts";

export class MapAsker extends SideAsker<MapQuestion, MapLine> {
  readonly #scene: () => Editing | null;

  constructor(channel: Channel, session: string, scene: () => Editing | null, changed: () => void) {
    super(channel, `${session}m`, changed);
    this.#scene = scene;
  }

  ask(text: string, plate: number, name: string): void {
    this.clear();
    this.question("/map", text, { plate }, `Looking where ${name} could be washed …`, "The map cannot be read.");
  }

  protected hear(line: MapLine): void {
    switch (line.kind) {
      case "map":
        return this.#scene()?.map(line);
      case "map_done":
      case "refused":
      case "failed":
        return this.say(line.words);
      default:
    }
  }

  protected forget(): void {
    this.#scene()?.map(null);
  }
}

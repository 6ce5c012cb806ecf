/** `window.platewash.edit`: the live cell in the hands of a test. */
import type { Selected } from "./moves.ts";
import type { Activity, Standing } from "./standing.ts";
import type { Timing } from "./timings.ts";
import type { Edit } from "./version.ts";

export interface EditHandle {
  /** The scenario as far as it is written out. */
  text(): string;
  /** Whether it is. */
  written(): boolean;
  state(): Activity;
  verdict(): Standing;
  /** False where there is nothing to take back. */
  undo(): boolean;
  redo(): boolean;
  /** As a change of the form: one step. */
  change(edits: Edit[]): void;
  save(): void;
  unsaved(): boolean;
  /** Where plates are [m]. */
  centres(): [number, number][];
  selected(): Selected;
  /** Where plates that stand in the way could lie [m]. */
  ghosts(): { plate: number; centre_m: [number, number] }[];
  /** The last questions. */
  timings(): Timing[];
  /** Everything was answered and drawn. */
  settled(): Promise<void>;
}

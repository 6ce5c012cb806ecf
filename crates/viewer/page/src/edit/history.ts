/** Every scenario that there was, to go back to and forth again: without end. */
import { sameVersion, type Version } from "./version.ts";

export interface Step {
  readonly version: Version;
  /** What led to it. */
  readonly label: string;
}

export class History {
  #steps: Step[];
  #at: number;

  /** Goes on with steps that were stored, or begins with one. */
  constructor(steps: readonly Step[], at = steps.length - 1) {
    if (steps.length === 0) throw new RangeError("a history without a scenario");
    this.#steps = [...steps];
    this.#at = Math.max(0, Math.min(steps.length - 1, at));
  }

  get version(): Version {
    return this.#steps[this.#at]!.version;
  }

  get steps(): readonly Step[] {
    return this.#steps;
  }

  get at(): number {
    return this.#at;
  }

  /** What undoing would take back; null where there is nothing. */
  get undoes(): string | null {
    return this.#at > 0 ? this.#steps[this.#at]!.label : null;
  }

  /** What redoing would do again. */
  get redoes(): string | null {
    return this.#steps[this.#at + 1]?.label ?? null;
  }

  /** A new step, unless nothing is different; whether it is one. What was undone is gone. */
  commit(version: Version, label: string): boolean {
    if (sameVersion(version, this.version)) return false;
    this.#steps.length = this.#at + 1;
    this.#steps.push({ version, label });
    this.#at++;
    return true;
  }

  /** Another version in place of the newest step's: for changes that follow each other closely. */
  amend(version: Version): void {
    this.#steps.length = this.#at + 1;
    this.settle(version);
  }

  /** The version that stands now as it is written out. Where that is no other than the step before, there was no step. */
  settle(version: Version): void {
    const { label } = this.#steps[this.#at]!;
    this.#steps[this.#at] = { version, label };
    for (const beside of [this.#at - 1, this.#at]) {
      const [one, next] = [this.#steps[beside], this.#steps[beside + 1]];
      if (one === undefined || next === undefined || !sameVersion(one.version, next.version)) continue;
      this.#steps.splice(beside + 1, 1);
      if (beside < this.#at) this.#at--;
    }
  }

  undo(): boolean {
    if (this.#at === 0) return false;
    this.#at--;
    return true;
  }

  redo(): boolean {
    if (this.#at + 1 >= this.#steps.length) return false;
    this.#at++;
    return true;
  }
}

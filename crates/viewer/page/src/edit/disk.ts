/** The scenario's file: what stands there, what was changed there by others, and saving. */
import type { Time } from "./asker.ts";
import { askOnce, ChannelError, type Channel } from "./channel.ts";
import type { DiskLine, DiskQuestion, SaveLine, SaveQuestion } from "./protocol.ts";

/** Time between two looks at the disk [ms]. */
export const EVERY_MS = 1000;

/** What has to be decided: the file has another text than the page took it to have. */
export interface Conflict {
  words: string;
  /** Null where it is no text, so that it cannot be taken. */
  text: string | null;
  disk: string | null;
  /** Whether somebody wanted to save. */
  saving: boolean;
}

export interface DiskActions {
  /** The scenario as it is now; null while changes to it are not written out, or refused. */
  text(): string | null;
  /** Takes another text over, as a step. */
  take(text: string, words: string): void;
  /** Says something in passing. */
  notice(words: string): void;
  changed(): void;
}

export class Disk {
  readonly #channel: Channel;
  readonly #time: Time;
  readonly #session: string;
  readonly #actions: DiskActions;
  /** What stands on disk as far as the page knows: its hash, and its text where that is known. */
  #known: { disk: string | null; saved: string | null };
  #conflict: Conflict | null = null;
  /** What was on disk when somebody chose to keep the page's own. */
  #kept: string | null | undefined;
  #saving = false;
  #busy = false;
  #abort = new AbortController();

  constructor(channel: Channel, time: Time, session: string, known: { disk: string | null; saved: string | null }, actions: DiskActions) {
    this.#channel = channel;
    this.#time = time;
    this.#session = session;
    this.#known = known;
    this.#actions = actions;
  }

  get known(): Readonly<{ disk: string | null; saved: string | null }> {
    return this.#known;
  }

  get conflict(): Conflict | null {
    return this.#conflict;
  }

  get saving(): boolean {
    return this.#saving;
  }

  /** Whether the scenario is another than on disk. */
  get unsaved(): boolean {
    const text = this.#actions.text();
    return text === null || text !== this.#known.saved;
  }

  /** Looks at the disk every second, while `visible`. */
  watch(visible: () => boolean): void {
    this.#time.later(() => {
      const look = visible() ? this.look() : Promise.resolve();
      void look.then(() => this.watch(visible));
    }, EVERY_MS);
  }

  /** Looks at the disk once. */
  async look(): Promise<void> {
    if (this.#busy || this.#saving) return;
    this.#busy = true;
    const before = this.#known;
    try {
      const question: DiskQuestion = { session: this.#session, disk: this.#kept === undefined ? before.disk : this.#kept };
      const line = (await askOnce(this.#channel, "/disk", question, this.#abort.signal)) as DiskLine | null;
      if (line?.kind === "disk" && this.#known === before && !this.#saving) this.#seen(line, question.disk);
    } catch {
      // The cell's own questions say that the connection is lost.
    } finally {
      this.#busy = false;
    }
  }

  /** Saves; `force`: whatever stands there. */
  async save(force = false): Promise<void> {
    const text = this.#actions.text();
    if (this.#saving) return;
    if (text === null) return this.#actions.notice("Not saved: the scenario has changes that are refused or not written out yet.");
    this.#saving = true;
    this.#actions.changed();
    try {
      const question: SaveQuestion = { session: this.#session, text, disk: this.#known.disk, force };
      this.#saved((await askOnce(this.#channel, "/save", question, this.#abort.signal)) as SaveLine | null, text);
    } catch (error) {
      this.#actions.notice(`Not saved. ${error instanceof ChannelError ? error.message : ""}`.trim());
    } finally {
      this.#saving = false;
      this.#actions.changed();
    }
  }

  /** Takes what stands on disk. */
  take(): void {
    const conflict = this.#conflict;
    if (conflict === null || conflict.text === null) return;
    this.#settle(conflict.disk, conflict.text);
    this.#actions.take(conflict.text, "Take the file’s text");
    this.#actions.changed();
  }

  /** Keeps the page's own; saving will ask again. */
  keep(): void {
    if (this.#conflict === null) return;
    this.#kept = this.#conflict.disk;
    this.#conflict = null;
    this.#actions.changed();
  }

  #settle(disk: string | null, saved: string | null): void {
    this.#known = { disk, saved };
    this.#conflict = null;
    this.#kept = undefined;
  }

  #seen(line: DiskLine, asked: string | null): void {
    // What was kept apart while the answer was under way is not asked about again.
    if (line.disk === asked || line.disk === this.#kept) return;
    if (line.disk === null || line.text === null) {
      const words = line.words ?? (line.disk === null ? "The file is no longer there." : "The file has changed on disk and cannot be read as text.");
      this.#open({ words, text: null, disk: line.disk, saving: false });
    } else if (line.text === this.#actions.text()) {
      this.#settle(line.disk, line.text);
    } else if (this.unsaved) {
      this.#open({ words: "The file has changed on disk.", text: line.text, disk: line.disk, saving: false });
    } else {
      this.#settle(line.disk, line.text);
      this.#actions.take(line.text, "Changed on disk");
      this.#actions.notice("The file has changed on disk: its text was taken over. Undo brings back what was here.");
    }
    this.#actions.changed();
  }

  #open(conflict: Conflict): void {
    if (this.#conflict?.saving === true && this.#conflict.disk === conflict.disk) return;
    this.#conflict = conflict;
  }

  #saved(line: SaveLine | null, text: string): void {
    switch (line?.kind) {
      case "saved":
        this.#settle(line.disk, text);
        return this.#actions.notice(savedWords(line));
      case "conflict":
        this.#conflict = { words: line.words, text: line.text, disk: line.disk, saving: true };
        return;
      case "failed":
        return this.#actions.notice(`Not saved. ${line.words}`);
      default:
        return this.#actions.notice("Not saved: the answer cannot be read.");
    }
  }
}

/** What was written, and what came of it. */
function savedWords({ file, files, words }: Extract<SaveLine, { kind: "saved" }>): string {
  const more = files.length - 1;
  const beside = more > 0 ? ` and ${more} file${more === 1 ? "" : "s"} beside it` : "";
  return `Saved ${file}${beside}. ${words}`;
}

/** A live cell in the page: its state, its panels, and what ties them to the rest of the page. */
import type { EditActions, Editing } from "../scene/editing.ts";
import { announce, byId } from "../shell/dom.ts";
import type { Panel } from "../shell/panels.ts";
import { type Verdict, verdict } from "../verdict.ts";
import type { View } from "../view.ts";
import { editVerdict, isStale, NOT_APPLIED } from "./answers.ts";
import { BROWSER_TIME } from "./asker.ts";
import { CellPanel } from "./cell-panel.ts";
import { Cell } from "./cell.ts";
import { type Channel, FrameChannel, HttpChannel, keptToken, takeToken } from "./channel.ts";
import { Commands, listenToEditKeys, plateKey } from "./commands.ts";
import { Disk } from "./disk.ts";
import { Form, TextPanel } from "./form.ts";
import { type Edit, Keeper, tabStore } from "./history.ts";
import { MapAsker } from "./map.ts";
import type { EditDocument } from "./protocol.ts";
import { readJoints, RecoveryAsker } from "./recovery.ts";
import { CellShown } from "./shown.ts";
import { ConflictBar, Toolbar } from "./toolbar.ts";

/** Notes when plans and proofs are drawn, and who waits for that. */
class Drawings {
  readonly #cell: Cell;
  #waiting: (() => void)[] = [];

  constructor(cell: Cell) {
    this.#cell = cell;
  }

  /** A frame was drawn at `now` [ms]; `all`: nothing has changed since. */
  drawn(now: number, all: boolean): void {
    const timing = this.#cell.planned?.timing ?? null;
    if (timing !== null && all) {
      if (timing.plan !== null) timing.drawnPlan ??= now;
      if (timing.proof !== null) timing.drawnProof ??= now;
    }
    if (!all || !this.#cell.settled || this.#waiting.length === 0) return;
    const waiting = this.#waiting;
    this.#waiting = [];
    for (const done of waiting) done();
  }

  settled(): Promise<void> {
    return new Promise((resolve) => this.#waiting.push(resolve));
  }
}

export interface EditorHost {
  /** Lets hands move plates in the scene; null where there is none. */
  edit(actions: EditActions): Editing | null;
  /** Of the scene's canvas [CSS px]. */
  size(): [number, number];
  replace(view: View): void;
  /** `stale`: something is changed that the plan does not have. */
  say(verdict: Verdict, stale: boolean): void;
  /** Writes further entries into the page's address. */
  link(entries: Readonly<Record<string, string>>): void;
  /** Time of the film that is shown [s]. */
  time(): number;
  /** Goes to a time of the film [s]. */
  seek(t: number): void;
}

/** What tools of the playground do with the cell. */
export interface PlaygroundCell {
  /** The scenario with what is being typed; null while changes are not written out, or refused. */
  commit(): string | null;
  /** Takes another text, as a step. */
  take(text: string, label: string): void;
  /** Says something in passing. */
  notice(words: string): void;
  /** Writes entries into the page's address. */
  link(entries: Readonly<Record<string, string>>): void;
}

/** What stands in the place of a server and its file. */
export interface Playground {
  channel: Channel;
  /** The cell is there; tools to show beside undo and redo. */
  begin(cell: PlaygroundCell): HTMLElement[];
  /** Another text stands. */
  changed(text: string): void;
  save(): void;
}

/** How long a verdict stands before it is read out [ms]. */
const SPOKEN_MS = 600;
/** How long a notice stays [ms]. */
const NOTICE_MS = 8000;
const NO_VALUES = {};

export class Editor {
  readonly panels: Panel[];
  readonly #document: EditDocument;
  readonly #host: EditorHost;
  readonly #playground: Playground | null;
  readonly #cell: Cell;
  readonly #disk: Disk;
  readonly #keeper: Keeper;
  readonly #shown: CellShown;
  readonly #commands: Commands;
  readonly #map: MapAsker;
  readonly #recovery: RecoveryAsker;
  /** The recovery that stands in the place of the plan. */
  #recovered: View | null = null;
  /** Time of the plan's film before that [s]. */
  #stoppedAt = 0;
  #scene: Editing | null = null;
  readonly #drawings: Drawings;
  readonly #toolbar: Toolbar;
  readonly #cellPanel: CellPanel;
  readonly #form: Form;
  readonly #text: TextPanel;
  readonly #bar: ConflictBar;
  #file: string | null;
  #notice = { words: "", until: 0, of: "" };
  #spoken = { words: "", since: 0, said: true };
  #changed = true;
  /** What is in the tab's store. */
  #kept: { version: unknown; known: unknown } | null = null;
  /** Somebody wants to save what is not written out yet. */
  #saveSoon = false;

  constructor(edit: EditDocument, view: View, host: EditorHost, playground: Playground | null) {
    this.#document = edit;
    this.#host = host;
    this.#playground = playground;
    this.#file = edit.file;
    this.#keeper = new Keeper(tabStore(), playground === null ? (edit.file ?? edit.text) : "playground");
    const channel = this.#channel();
    const session = newSession();
    const stored = this.#keeper.load();
    // The address of a playground has its scenario, and decides.
    const kept = playground === null || stored?.steps[stored.at]?.version.text === edit.text ? stored : null;
    const steps = kept?.steps ?? [{ version: { text: edit.text, edits: [] }, label: "" }];
    const touch = (): void => this.#touch();
    this.#cell = new Cell({ channel, time: BROWSER_TIME, session, steps, at: kept?.at ?? 0, onChange: touch });
    const known = kept === null ? { disk: edit.disk, saved: edit.saved } : { disk: kept.disk, saved: kept.saved };
    this.#disk = new Disk(channel, BROWSER_TIME, session, known, {
      text: () => this.#writtenText(),
      take: (text, words) => this.#cell.setText(text, words),
      notice: (words) => this.#say(words),
      changed: touch,
    });
    this.#shown = new CellShown(view, () => this.#scene, (next) => host.replace(next));
    this.#commands = new Commands(this.#cell, () => this.#shown.view, () => this.#scene, () => host.size(), touch, (words) => this.#say(words));
    this.#map = new MapAsker(channel, session, () => this.#scene, touch);
    this.#recovery = new RecoveryAsker(channel, session, touch);
    this.#drawings = new Drawings(this.#cell);
    const tools = playground?.begin(this.#forPlayground()) ?? [];
    this.#toolbar = new Toolbar({ undo: () => this.#travel("Undone"), redo: () => this.#travel("Done again"), save: () => this.#save() }, tools);
    this.#cellPanel = new CellPanel(this.#commands, {
      map: (plate) => this.#map.ask(this.#cell.text, plate, this.#cell.seen.drawn?.plates[plate]?.name ?? "the plate"),
      clearMap: () => this.#map.clear(),
      recover: (joints) => this.#recover(joints),
      clearRecovery: () => this.#recovery.clear(),
      key: (event) => this.#key(event),
    });
    this.#form = new Form(edit.keys, (key, value) => this.#cell.change([{ key, value }], value === null ? `Reset ${key}` : `Change ${key}`, key));
    this.#text = new TextPanel((text) => this.#cell.setText(text, "Change the text"));
    this.#bar = new ConflictBar(() => this.#disk);
    this.panels = [
      { id: "cell", title: "Cell", content: this.#cellPanel.element },
      { id: "keys", title: "Settings", content: this.#form.element },
      { id: "text", title: "Text", content: this.#text.element },
    ];
  }

  /** Begins: asks about the scenario, and listens to hands and keys. */
  start(canvas: HTMLCanvasElement): void {
    document.documentElement.dataset["editing"] = "";
    this.#scene = this.#host.edit(this.#commands);
    byId("panels").prepend(this.#toolbar.element);
    for (const type of ["input", "change", "focusout", "keyup"]) byId("panels").addEventListener(type, () => this.#touch());
    listenToEditKeys(canvas, {
      undo: () => this.#travel("Undone"),
      redo: () => this.#travel("Done again"),
      save: () => this.#save(),
      plate: (event) => this.#key(event),
    });
    addEventListener("beforeunload", (event) => {
      if (this.#playground === null && !this.#keeper.works && this.#disk.unsaved) event.preventDefault();
    });
    this.#cell.start();
    if (this.#file !== null) this.#disk.watch(() => !document.hidden);
  }

  /** Brings the page up to the cell, once a frame. */
  advance(now: number): void {
    this.#shown.update(this.#cell, now);
    this.#speak(now);
    const stale = now > this.#notice.until || this.#notice.of !== this.#cell.text;
    if (this.#notice.words !== "" && stale) this.#say("");
    if (!this.#changed) return;
    this.#changed = false;
    if (this.#saveSoon && (this.#cell.version.edits.length === 0 || this.#cell.settled)) this.#save();
    const changing = this.#cell.version.edits.length > 0;
    this.#map.follow(this.#cell.text, changing);
    this.#recovery.follow(this.#cell.text, changing);
    this.#showRecovery();
    this.#keep();
    this.#show();
  }

  /** The frame is drawn. */
  drawn(now: number): void {
    this.#drawings.drawn(now, !this.#changed);
  }

  /** `window.platewash.edit`: the live cell in the hands of a test. */
  get handle() {
    const cell = this.#cell;
    return {
      /** The scenario as far as it is written out, and whether it is. */
      text: () => cell.text,
      written: () => cell.version.edits.length === 0,
      state: () => cell.state,
      verdict: () => cell.standing,
      /** False where there is nothing to take back. */
      undo: () => cell.undo(),
      redo: () => cell.redo(),
      /** As a change of the form: one step. */
      change: (edits: readonly Edit[]) => cell.change(edits, "Change"),
      save: () => this.#save(),
      unsaved: () => this.#disk.unsaved,
      /** Where plates are [m]. */
      centres: () => structuredClone(cell.centres),
      selected: () => this.#commands.selected,
      /** Where plates that stand in the way could lie [m]. */
      ghosts: () => cell.answers.places.flatMap(({ plate, nearest_m }) => (nearest_m === null ? [] : [{ plate, centre_m: nearest_m }])),
      /** What is said about a recovery; null for none. */
      recovery: () => this.#recovery.words,
      /** The last questions. */
      timings: () => cell.timings,
      /** Everything was answered and drawn. */
      settled: () => this.#drawings.settled(),
    };
  }

  /** Asks for the way on from the joints that are typed, or from where the plan has the arm at the moment shown. */
  #recover(joints: string): void {
    const [at_deg, { text }] = [readJoints(joints), this.#cell];
    const refuse = (words: string): void => this.#recovery.refuse(text, words);
    if (at_deg === "not six") return refuse("Joints: expected six numbers in degrees, or nothing for the moment shown.");
    if (this.#cell.standing.kind !== "proved") return refuse("A recovery is one of a proved plan; this one is not proved.");
    if (at_deg === null && this.#recovered !== null) return refuse("The plan is shown again: choose its moment, and press Recover.");
    this.#recovery.ask(text, at_deg === null ? this.#host.time() : null, at_deg);
  }

  /** Puts the motion home in the place of the plan, or the plan back. */
  #showRecovery(): void {
    const { view } = this.#recovery;
    if (view === this.#recovered) return;
    // From the plan to the beginning of the way home, and back to the moment of before.
    const t = this.#recovered === null ? 0 : this.#stoppedAt;
    if (this.#recovered === null) this.#stoppedAt = this.#host.time();
    this.#recovered = view;
    this.#host.replace(view ?? this.#shown.view);
    this.#host.seek(t);
  }

  #forPlayground(): PlaygroundCell {
    return {
      commit: () => {
        this.#endTyping();
        return this.#writtenText();
      },
      take: (text, label) => this.#cell.setText(text, label),
      notice: (words) => this.#say(words),
      link: (entries) => this.#host.link(entries),
    };
  }

  #channel(): Channel {
    if (this.#playground !== null) return this.#playground.channel;
    if (this.#document.channel === "frame") return new FrameChannel(window, (text) => this.#cell.setText(text, "From the notebook"));
    takeToken();
    return new HttpChannel(keptToken, ({ file }) => {
      if (file !== this.#file) this.#say(`Another platewash answers now${file === null ? "" : `, of ${file}`}: saving goes there.`);
      this.#file = file;
    });
  }

  #key(event: KeyboardEvent): boolean {
    const used = plateKey(event, this.#commands, () => this.#cancel());
    if (!used && event.key === "Escape") {
      this.#map.clear();
      this.#recovery.clear();
    }
    return used;
  }

  /** Gives up the newest of what can be given up. */
  #cancel(): void {
    if (this.#cell.dragging) this.#cell.cancelDrag();
    else if (this.#map.words !== null) this.#map.clear();
    else {
      this.#commands.select(null);
      this.#commands.selectBody(null);
    }
  }

  /** Saves, with what is being typed. */
  #save(): void {
    this.#endTyping();
    this.#saveSoon = this.#cell.version.edits.length > 0 && !this.#cell.settled;
    if (this.#saveSoon) return;
    if (this.#playground === null) void this.#disk.save();
    else this.#playground.save();
  }

  /** Takes what is being typed. */
  #endTyping(): void {
    if (document.activeElement instanceof HTMLElement && document.activeElement.dataset["dirty"] === "true") document.activeElement.blur();
  }

  /** The scenario; null while changes to it are not written out, or refused. */
  #writtenText(): string | null {
    return this.#cell.version.edits.length > 0 ? null : this.#cell.text;
  }

  #touch(): void {
    this.#changed = true;
  }

  #say(words: string): void {
    this.#notice = { words, until: performance.now() + NOTICE_MS, of: this.#cell.text };
    if (words !== "") announce(words);
    this.#touch();
  }

  /** Goes back or forth, and says what that was. */
  #travel(verb: "Undone" | "Done again"): boolean {
    const { undoes, redoes } = this.#cell.history;
    const [went, label] = verb === "Undone" ? [this.#cell.undo(), undoes] : [this.#cell.redo(), redoes];
    announce(went ? `${verb}: ${label ?? ""}` : `Nothing to ${verb === "Undone" ? "undo" : "redo"}`);
    return went;
  }

  #show(): void {
    const [cell, disk] = [this.#cell, this.#disk];
    this.#steady(cell.dragging);
    const { answers, standing, seen } = cell;
    const unsaved = this.#file !== null && disk.unsaved;
    const typing = byId("panels").querySelector('[data-dirty="true"]') !== null;
    const said = this.#recovered === null ? editVerdict(standing, answers, this.#shown.view) : verdict(this.#recovered);
    this.#host.say(typing ? NOT_APPLIED : said, typing || isStale(standing));
    const { undoes, redoes } = cell.history;
    this.#toolbar.show({ undoes, redoes, activity: cell.state, file: this.#file, unsaved, saving: disk.saving, notice: this.#notice.words });
    this.#cellPanel.show(cell, this.#commands.selected, this.#map.words, this.#recovery.words);
    const { refused } = answers;
    const key = refused?.key ?? null;
    this.#form.show({ stated: seen.scenario?.stated ?? NO_VALUES, values: seen.scenario?.values ?? NO_VALUES, refused: key === null ? null : { key, words: refused!.words } });
    this.#text.show(cell.text, refused, cell.version.edits.length > 0 && !cell.dragging);
    this.#bar.show(disk.conflict);
    const title = document.title.replace(/^• /, "");
    if (document.title.startsWith("• ") !== unsaved) document.title = unsaved ? `• ${title}` : title;
  }

  /** Keeps the scene where it is while something is dragged: the header lies over it as far as a verdict takes more lines. */
  #steady(dragging: boolean): void {
    const root = document.documentElement;
    if (root.hasAttribute("data-dragging") === dragging) return;
    const height = dragging ? `${byId("header").getBoundingClientRect().height}px` : "";
    document.body.style.paddingTop = byId("header").style.minHeight = height;
    root.toggleAttribute("data-dragging", dragging);
  }

  /** Says a verdict once it stands. */
  #speak(now: number): void {
    const words = this.#cell.settled ? this.#cell.standing.words : "";
    if (words !== this.#spoken.words) {
      const again = words === "";
      this.#spoken = { words, since: now, said: again };
    }
    if (this.#spoken.said || now - this.#spoken.since < SPOKEN_MS) return;
    this.#spoken.said = true;
    announce(words);
  }

  #keep(): void {
    const { steps, at, version } = this.#cell.history;
    const { known } = this.#disk;
    if (version === this.#kept?.version && known === this.#kept.known) return;
    this.#kept = { version, known };
    if (version.edits.length === 0) this.#playground?.changed(version.text);
    this.#keeper.save({ steps, at, ...known });
  }
}

/** A name of this load of the page: two tabs must not stop each other's questions. */
function newSession(): string {
  const bytes = crypto.getRandomValues(new Uint8Array(12));
  return [...bytes].map((byte) => byte.toString(16).padStart(2, "0")).join("");
}

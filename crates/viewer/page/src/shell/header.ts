/** The strip above everything: what the page is with its verdict, what that rests on, time and hash; and the state of a live run. */
import { counted, fixed, quantity } from "../format.ts";
import type { LivePhase } from "../live.ts";
import type { Player } from "../player.ts";
import { assumptions, statusWord, type Verdict, verdict, washed, VERDICT } from "../verdict.ts";
import type { View } from "../view.ts";
import { announce, button, byId, type Child, el, icon, isolated, TextCell, toneIcon } from "./dom.ts";

/** A verdict as a badge: sign, word and colour. */
function badge(of: Verdict, extra = ""): HTMLElement {
  return el("span", { class: `badge tone-${of.tone} ${extra}`.trim(), title: of.sentence }, toneIcon(of.tone), of.word);
}

function fact(name: string, ...value: Child[]): HTMLElement {
  return el("div", { class: "fact" }, el("dt", {}, name), el("dd", {}, ...value));
}

function copyButton(text: string): HTMLButtonElement {
  return button({ class: "button bare-button", label: "Copy the plan’s hash" }, () => {
    navigator.clipboard
      ?.writeText(text)
      .then(() => announce("Hash copied"))
      .catch(() => announce("The browser does not let this page copy; About shows the hash in full"));
  }, icon("copy"));
}

/** Cycle time and hash of a plan; `before` says of which one. */
function facts(view: View, before: string): HTMLElement[] {
  const { heading, certificate } = view;
  const list: HTMLElement[] = [];
  if (view.motion !== null) list.push(fact(`${before}cycle`, quantity(heading.duration_s, 2, "s")));
  if (heading.hash !== null) {
    const altered = certificate !== null && certificate.hash !== "proved" ? ` (${statusWord(certificate.hash).toLowerCase()})` : "";
    const short = el("code", { title: heading.hash }, heading.hash.slice(0, 10));
    list.push(fact(`${before}hash`, short, altered, copyButton(heading.hash)));
  }
  return list;
}

const KINDS = { wash: "Wash plan", paper: "The paper’s program" } as const;

/** What the page shows, before its verdict; of a dry run its headline says that first. */
function subject({ heading }: View, edited: boolean): string {
  if (heading.dry_run !== null) return "";
  const kind = heading.process === null ? "Configuration" : edited ? "Live wash plan" : KINDS[heading.process];
  return `${kind} “${heading.scenario}”: `;
}

function same(a: Verdict, b: Verdict): boolean {
  return a.tone === b.tone && a.word === b.word && a.sentence === b.sentence;
}

/** Fills the header; its tint is the verdict's. */
export class Header {
  readonly #root = byId("header");
  readonly #badges = el("div", { class: "badges" });
  readonly #sentence = el("h1", { class: "sentence" });
  readonly #rests = el("p", { class: "rests" });
  readonly #facts = el("dl", { class: "facts" });
  readonly #toAssumptions: () => void;
  #view: View;
  /** The last document that was proved; the first one where none was. */
  valid: View;
  /** What is to be said in place of the view's own verdict. */
  #said: Verdict | null = null;
  /** Whether something is changed that the plan does not have. */
  #stale = false;
  #factsShown = "";

  constructor(view: View, tools: readonly HTMLElement[], toAssumptions: () => void) {
    this.#view = this.valid = view;
    this.#toAssumptions = toAssumptions;
    this.#root.replaceChildren(
      this.#badges,
      el("div", { class: "heading" }, this.#sentence, this.#rests),
      this.#facts,
      el("div", { class: "tools" }, ...tools),
    );
    this.update();
  }

  /** Is about another document. */
  replace(view: View): void {
    this.#view = view;
    if (view.certificate?.passes === true) this.valid = view;
    this.update();
  }

  /** Says a verdict in place of the document's own; null for that again. `stale`: something is changed that the plan does not have. */
  say(said: Verdict | null, stale: boolean): void {
    if (said !== null && this.#said !== null && same(said, this.#said) && stale === this.#stale) return;
    this.#said = said;
    this.#stale = stale;
    this.update();
  }

  /** Again from the view, whose execution a live run completes. */
  update(): void {
    const of = this.#said ?? verdict(this.#view);
    const result = washed(this.#view);
    this.#root.className = `tone-${of.tone === "proved" && result?.tone === "violated" ? "violated" : of.tone}`;
    this.#badges.replaceChildren(badge(of));
    if (result !== null) this.#badges.append(badge(result, "badge-small"));
    const words = of.sentence.replace(VERDICT, "");
    this.#sentence.replaceChildren(isolated(subject(this.#view, this.#said !== null)), isolated(words));
    this.#showRests(this.#stale ? [] : assumptions(this.#view.certificate));
    this.#showFacts();
    document.documentElement.dataset["verdict"] = of.tone;
  }

  /** The first assumption, and the way to the others. */
  #showRests([first, ...others]: string[]): void {
    this.#rests.hidden = first === undefined;
    if (first === undefined) return;
    const all = button({ class: "link" }, this.#toAssumptions, others.length === 0 ? "Details" : counted(others.length, "more assumption"));
    this.#rests.replaceChildren("This rests on: ", isolated(first), "; ", all);
  }

  /** Cycle time and hash: made anew only where they differ, so that a button keeps its focus. */
  #showFacts(): void {
    const view = this.#stale ? this.valid : this.#view;
    const shown = JSON.stringify([this.#stale, view.heading, view.motion === null, view.certificate?.hash]);
    if (shown === this.#factsShown) return;
    this.#factsShown = shown;
    const known = !this.#stale || view.certificate?.passes === true;
    this.#facts.replaceChildren(...(known ? facts(view, this.#stale ? "last valid " : "") : []));
    this.#facts.classList.toggle("stale", this.#stale);
  }
}


const WORDS: Record<LivePhase, string> = {
  connecting: "connecting …",
  waiting: "waiting for the run to begin",
  running: "running",
  reconnecting: "connection lost: trying again …",
  done: "done",
};

export class Banner {
  readonly element: HTMLElement;
  readonly #player: Player;
  readonly #words = new TextCell();
  readonly #lag = new TextCell();
  readonly #back: HTMLButtonElement;
  #phase: LivePhase | null = null;

  constructor(player: Player, toNewest: () => void) {
    this.#player = player;
    this.#back = button({ class: "button text-button" }, toNewest, "Back to live");
    this.element = el(
      "div",
      { class: "banner" },
      el("span", { class: "banner-dot", set: { "aria-hidden": "true" } }),
      el("strong", {}, "LIVE"),
      el("span", {}, this.#words.node),
      el("span", { class: "banner-lag" }, this.#lag.node),
      this.#back,
    );
    this.element.hidden = player.phase === null;
  }

  update(): void {
    const { phase, live, newest, lag } = this.#player;
    if (phase === null) return;
    if (phase !== this.#phase) {
      this.#phase = phase;
      this.element.dataset["phase"] = phase;
      this.#words.set(WORDS[phase]);
      announce(`Live run: ${WORDS[phase]}`);
    }
    this.#back.hidden = !live || newest;
    this.#lag.set(live && lag > 0 ? `${fixed(lag, 1)} s behind` : "");
  }
}

/** The strip above everything: the verdict first, then the plan's name and time; and the state of a live run. */
import { fixed, quantity } from "../format.ts";
import type { LivePhase } from "../live.ts";
import type { Player } from "../player.ts";
import { statusWord, type Verdict, verdict, washed } from "../verdict.ts";
import type { View } from "../view.ts";
import { announce, button, byId, type Child, el, icon, isolated, TextCell, toneIcon } from "./dom.ts";

/** Characters of a tooltip at most. */
const TITLE = 300;

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

function facts(view: View): HTMLElement[] {
  const { heading, certificate } = view;
  const list: HTMLElement[] = [];
  if (view.motion !== null) list.push(fact("cycle", quantity(heading.duration_s, 2, "s")));
  if (heading.process !== null) list.push(fact("seed", String(heading.seed)));
  list.push(fact("arm", isolated(heading.robot)));
  if (heading.hash !== null) {
    const altered = certificate !== null && certificate.hash !== "proved" ? ` (${statusWord(certificate.hash).toLowerCase()})` : "";
    const short = el("code", { title: heading.hash }, heading.hash.slice(0, 10));
    list.push(fact("hash", short, altered, copyButton(heading.hash)));
  }
  return list;
}

function same(a: Verdict, b: Verdict): boolean {
  return a.tone === b.tone && a.word === b.word && a.sentence === b.sentence;
}

/** Fills the header; its tint is the verdict's. */
export class Header {
  readonly #root = byId("header");
  readonly #badges = el("div", { class: "badges" });
  readonly #sentence = el("p", { class: "sentence" });
  readonly #scenario = el("h1", { class: "scenario" });
  readonly #facts = el("dl", { class: "facts" });
  #view: View;
  /** What is to be said in place of the view's own verdict. */
  #said: Verdict | null = null;

  constructor(view: View, tools: readonly HTMLElement[]) {
    this.#view = view;
    this.#root.replaceChildren(
      this.#badges,
      el("div", { class: "heading" }, this.#scenario, this.#sentence),
      this.#facts,
      el("div", { class: "tools" }, ...tools),
    );
    this.#name();
    this.update();
  }

  /** Is about another document. */
  replace(view: View): void {
    const other = JSON.stringify(view.heading) !== JSON.stringify(this.#view.heading) || view.certificate?.hash !== this.#view.certificate?.hash;
    this.#view = view;
    if (other) this.#name();
    this.update();
  }

  /** Says a verdict in place of the document's own; null for that again. */
  say(said: Verdict | null): void {
    if (said !== null && this.#said !== null && same(said, this.#said)) return;
    this.#said = said;
    this.update();
  }

  #name(): void {
    const name = this.#view.heading.scenario;
    this.#scenario.title = name.slice(0, TITLE);
    this.#scenario.replaceChildren(isolated(`“${name}”`));
    this.#facts.replaceChildren(...facts(this.#view));
  }

  /** Again from the view, whose execution a live run completes. */
  update(): void {
    const of = this.#said ?? verdict(this.#view);
    const result = washed(this.#view);
    this.#root.className = `tone-${of.tone === "proved" && result?.tone === "violated" ? "violated" : of.tone}`;
    this.#badges.replaceChildren(badge(of));
    if (result !== null) this.#badges.append(badge(result, "badge-small"));
    this.#sentence.replaceChildren(isolated(of.sentence));
    this.#sentence.title = of.sentence;
    document.documentElement.dataset["verdict"] = of.tone;
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

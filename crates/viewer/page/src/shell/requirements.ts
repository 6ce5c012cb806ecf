/** The requirements with their results in groups, broken ones first; what is proved of the contact with each plate; what the verdict rests on, and whose work is in the page. */
import FORMULAS from "../formulas.json" with { type: "json" };
import { fixed, fixedShort, percentDown, plateName, quantity } from "../format.ts";
import { grouped, measureWords, shareOf } from "../limits.ts";
import { isAssumed, statusWord, summary, verdict } from "../verdict.ts";
import type { Certificate, Check, Contact, PlateContact, View } from "../view.ts";
import { button, type Child, el, icon, isolated, toneIcon } from "./dom.ts";
import { keyTable } from "./keys.ts";

/** So many decimals, never smaller or never larger than it is. */
const up = (value: number, decimals: number): string => fixed(Math.ceil(value * 10 ** decimals - 1e-9) / 10 ** decimals, decimals);
const down = (value: number, decimals: number): string => fixed(Math.floor(value * 10 ** decimals + 1e-9) / 10 ** decimals, decimals);

/** Least and greatest force in words, rounded outwards. */
export function forceWords(least: number | undefined, greatest: number | undefined): string {
  return `${least === undefined ? "?" : down(least, 1)} – ${greatest === undefined ? "?" : up(greatest, 1)}`;
}

function row(view: View, asked: Contact["asked"], proved: PlateContact): HTMLElement {
  const cell = (holds: boolean, words: string): HTMLElement => el("td", { class: holds ? "" : "bad" }, words);
  const share = ({ at_least }: { at_least: number }, required: number): HTMLElement => cell(at_least >= required, percentDown(at_least));
  const [strain, least, greatest] = [proved.strain.bound, proved.least_force_n.bound, proved.greatest_force_n.bound];
  const holds = least !== undefined && greatest !== undefined && least >= asked.force_n[0] && greatest <= asked.force_n[1];
  return el(
    "tr",
    {},
    el("th", { set: { scope: "row" } }, isolated(plateName(view.plates, proved.plate))),
    share(proved.pressed, asked.share),
    share(proved.time, asked.time_share),
    share(proved.dose, asked.dose_share),
    cell(strain !== undefined && strain <= asked.strain, strain === undefined ? "?" : `${up(100 * strain, 1)}\u202f%`),
    cell(holds, forceWords(least, greatest)),
  );
}

/** Added where a plate has terms of its own. */
const OWN_TERMS = " Plates with a height error, a deviation or a soil of their own are judged by it: see the cards of the plates.";

/** In words what the columns say. */
export function contactWords({ asked, plates }: Contact): string {
  const mm = (length: number): string => `${fixedShort(1000 * length, 2)}\u202fmm`;
  const torques = plates.flatMap(({ friction_torque_nm: torque }) => (torque === undefined ? [] : [torque]));
  const most = [0, 1].map((k) => Math.max(...torques.map((torque) => torque[k]!)));
  const torque =
    torques.length === plates.length && plates.length > 0
      ? ` Friction turns the sponge by at most ${up(most[0]!, 2)} to ${up(most[1]!, 2)}\u202fN·m (friction 0.3 to 1.0, assumed).`
      : "";
  return (
    `Shares of each face, by its area, wherever within ±${mm(asked.height_error_m)} the plate lies: pressed by ${mm(asked.compression_m)} or more; ` +
    `so for ${fixedShort(asked.time_s, 3)}\u202fs or longer; with a dose of ${fixedShort(asked.dose_pa_m, 1)}\u202fPa·m or more. ` +
    `Strain at most ${fixedShort(100 * asked.strain, 1)}\u202f%, force from ${fixedShort(asked.force_n[0], 1)} to ${fixedShort(asked.force_n[1], 1)}\u202fN, ` +
    `over the assumed range of stiffness.${torque}`
  );
}

/** A heading, a sentence, and a row for each plate. */
export function contactTable(view: View, contact: Contact): HTMLElement[] {
  const { asked, plates } = contact;
  if (plates.length === 0) return [];
  const heads = ["", "pressed", "contact time", "contact dose", "strain", "contact force [N]"];
  const wanted = [asked.share, asked.time_share, asked.dose_share].map((share) => `≥\u202f${fixedShort(100 * share, 2)}\u202f%`);
  const head = el("tr", {}, ...heads.map((words) => el("th", { set: { scope: "col" } }, words)));
  const limits = el(
    "tr",
    { class: "asked" },
    el("th", { set: { scope: "row" } }, "asked for"),
    ...[...wanted, `${fixedShort(100 * asked.strain, 1)}\u202f%`, asked.force_n.map((force) => fixedShort(force, 1)).join(" – ")].map((words) => el("td", {}, words)),
  );
  const table = el(
    "table",
    { class: "joints contact" },
    el("thead", {}, head),
    el("tbody", {}, limits, ...plates.map((proved) => row(view, asked, proved))),
  );
  return [
    el("h3", { class: "brief-title" }, "Contact with each plate, proved"),
    el("p", { class: "summary" }, contactWords(contact) + (view.plates.some(({ own }) => own !== undefined) ? OWN_TERMS : "")),
    el("div", { class: "wide" }, table),
  ];
}

/** How much of its limit a bound takes, as a bar. */
function limitBar(share: number | null): HTMLElement | null {
  if (share === null) return null;
  const fill = el("span", { class: "bar-fill" });
  fill.style.transform = `scaleX(${Math.min(1, share).toFixed(4)})`;
  return el("span", { class: "bar", title: `${Math.ceil(100 * share - 1e-6)}\u202f% of the limit` }, fill);
}

/** Whether all that there is to say is that it is proved. */
function isBrief(check: Check): boolean {
  return check.status === "proved" && check.detail === "" && check.place === "" && Object.keys(check.worst).length === 0;
}

/** A formula of the documentation, drawn once its number is opened. */
function formula(number: string): HTMLElement {
  const element = el("details", { class: "formula" }, el("summary", {}, el("span", { class: "link" }, `formula (${number})`)));
  const math = (FORMULAS as Record<string, string>)[number] ?? "";
  element.addEventListener("toggle", () => element.append(...new DOMParser().parseFromString(math, "text/html").body.childNodes), { once: true });
  return element;
}

/** A requirement that opens: its sentence, whose its limit is, and how it is proved. */
function opened({ why: { sentence, section, formulas, limit } }: Check, ...shown: Child[]): HTMLElement {
  const words = el("p", {}, `${sentence} ${limit} `, el("span", { class: "cited" }, `Proof: ${section}.`));
  return el("details", { class: "why" }, el("summary", {}, ...shown), words, ...formulas.map(formula));
}

function worstButton(check: Check, onSelect: (check: Check) => void): HTMLElement | null {
  const { time_s, place_m, plate } = check.worst;
  const when = time_s === undefined ? "" : quantity(time_s, 2, "s");
  if (time_s === undefined && place_m === undefined && plate === undefined) {
    return check.place === "" ? null : el("span", { class: "where" }, isolated(check.place));
  }
  return button(
    { class: "where where-button", title: `Show where ${check.words} is worst` },
    () => onSelect(check),
    icon("target"),
    el("span", { class: "spoken" }, `${check.words}, worst: `),
    el("span", {}, when),
    isolated(check.place),
  );
}

export class Requirements {
  readonly element = el("div", { class: "requirements" });
  readonly #rows = new Map<Check, HTMLElement>();
  readonly #onSelect: (check: Check) => void;
  #view: View;
  /** What is shown in place of a document of which nothing is proved; null for itself. */
  #instead: View | null = null;

  constructor(view: View, onSelect: (check: Check) => void) {
    this.#onSelect = onSelect;
    this.#view = view;
    this.#show(view);
  }

  /** Shows those of another document. */
  replace(view: View): void {
    this.#view = view;
    this.#show(view.certificate === null ? (this.#instead ?? view) : view);
  }

  /** Shows those of another document where nothing is proved of this one; null for none. */
  showInstead(instead: View | null): void {
    if (instead === this.#instead) return;
    this.#instead = instead;
    if (this.#view.certificate === null) this.replace(this.#view);
  }

  #show(view: View): void {
    this.#rows.clear();
    this.element.replaceChildren();
    if (view.certificate === null) this.#without(view);
    else this.#table(view, view.certificate);
  }

  /** Marks the requirement whose worst place is shown. */
  mark(check: Check | null, scrolls = true): void {
    for (const [of, row] of this.#rows) row.classList.toggle("marked", of === check);
    if (check !== null && scrolls) this.#rows.get(check)?.scrollIntoView({ block: "nearest" });
  }

  #without(view: View): void {
    const { tone, sentence } = verdict(view);
    this.element.append(el("p", { class: `notice tone-${tone}` }, toneIcon(tone), sentence));
  }

  #table(view: View, certificate: Certificate): void {
    if (certificate.hash !== "proved") {
      const words = "The plan was changed after it was written: its hash does not match its contents.";
      this.element.append(el("p", { class: "notice tone-violated" }, toneIcon("violated"), words));
    }
    this.element.append(el("p", { class: "summary" }, `${summary(certificate)}. A bar shows how much of its limit is taken. Each opens: what it says, and whose limit it is.`));
    for (const { name, checks } of grouped(certificate.checks)) {
      const kept = checks.filter(({ status }) => status === "proved").length;
      const brief = checks.filter(isBrief);
      this.element.append(
        el("h3", { class: "group-title" }, name, " ", el("span", { class: "group-count" }, `${kept} of ${checks.length} proved`)),
        el("ul", { class: "checks" }, ...checks.filter((check) => !isBrief(check)).map((check) => this.#row(check))),
        el("ul", { class: "brief", set: { "aria-label": "Proved, with nothing to measure" } }, ...brief.map((check) => el("li", {}, opened(check, toneIcon("proved"), check.words)))),
      );
      if (name === "Washed" && certificate.contact !== null) this.element.append(...contactTable(view, certificate.contact));
    }
  }

  #row(check: Check): HTMLElement {
    const { status, measure, words } = check;
    const row = el(
      "li",
      { class: `check tone-${status}` },
      opened(
        check,
        el("span", { class: "requirement" }, toneIcon(status), el("span", { class: "spoken" }, `${statusWord(status)}: `), words),
        measure === undefined ? el("span", { class: "measure" }, statusWord(status)) : el("span", { class: "measure" }, measureWords(measure)),
        measure === undefined ? null : limitBar(shareOf(measure)),
      ),
      check.detail === "" || (status === "proved" && measure !== undefined) ? null : el("span", { class: "detail" }, isolated(check.detail)),
      worstButton(check, this.#onSelect),
    );
    this.#rows.set(check, row);
    return row;
  }
}

function restsOn(view: View): HTMLElement | null {
  const { rests_on: all } = view.certificate ?? { rests_on: [] };
  if (all.length === 0) return null;
  const lines = [...all.filter(isAssumed), ...all.filter((line) => !isAssumed(line))];
  const items = lines.map((line) => {
    const [, topic, rest] = /^([a-z ]{2,20}): (.+)$/su.exec(line) ?? [];
    return topic === undefined || rest === undefined
      ? el("li", {}, isolated(line))
      : el("li", {}, el("strong", {}, topic), " ", isolated(rest));
  });
  return el("section", {}, el("h3", {}, "What the verdict rests on"), el("ul", { class: "plain" }, ...items));
}

function sampled(view: View): HTMLElement | null {
  if (view.motion === null) return null;
  const words = [
    "The certificate bounds the motion at every moment; this page does not add to it. ",
    "Curves, clearance line and maps of what is swept are samples to look at, not the proof.",
  ];
  return el("section", {}, el("h3", {}, "Proved, and shown"), el("p", {}, ...words));
}

function origin(view: View): HTMLElement {
  const { heading } = view;
  const list = el("dl", { class: "origin" });
  const add = (name: string, value: HTMLElement | string): void => list.append(el("dt", {}, name), el("dd", {}, value));
  add("scenario", isolated(`“${heading.scenario}”`));
  add("arm", isolated(heading.robot));
  if (heading.hash !== null) add("hash", el("code", { class: "hash" }, heading.hash));
  if (view.execution?.law) add("control law", isolated(view.execution.law));
  if (view.execution?.headline) add("carried out", isolated(view.execution.headline));
  add("made by", `platewash ${view.version}`);
  return el("section", {}, el("h3", {}, "This plan"), list);
}

function notices(): HTMLElement | null {
  const text = document.getElementById("platewash-notices")?.textContent?.trim() ?? "";
  if (text === "") return null;
  return el("details", {}, el("summary", {}, "Licences of the code in this page"), el("pre", { class: "notices" }, text));
}

export function about(view: View): HTMLElement {
  const keys = el("section", { class: "about-keys" }, el("h3", {}, "Keys"), keyTable(view.motion !== null));
  return el("div", { class: "about" }, restsOn(view), sampled(view), origin(view), keys, notices());
}

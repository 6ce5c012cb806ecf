/** The requirements and what came of each: those that are not kept first. */
import { quantity } from "../format.ts";
import { statusWord, summary, verdict } from "../verdict.ts";
import type { Certificate, Check, Status, View } from "../view.ts";
import { contactTable } from "./contact.ts";
import { button, el, isolated } from "./dom.ts";
import { icon, toneIcon } from "./icons.ts";

const RANK: Record<Status, number> = { violated: 0, not_proved: 1, waived: 2, proved: 3 };

function statusCell(status: Status): HTMLElement {
  return el("span", { class: `status tone-${status}` }, toneIcon(status), statusWord(status));
}

/** Whether all that there is to say is that it is proved. */
function isBrief(check: Check): boolean {
  return check.status === "proved" && check.detail === "" && check.worst === null;
}

function worstButton(check: Check, onSelect: (check: Check) => void): HTMLElement | null {
  const worst = check.worst;
  if (worst === null) return null;
  const when = worst.time_s === null ? "" : quantity(worst.time_s, 2, "s");
  if (worst.time_s === null && worst.place_m === null) {
    return worst.words === "" ? null : el("span", { class: "where" }, isolated(worst.words));
  }
  return button(
    { class: "where where-button", title: `Show where ${check.words} is worst` },
    () => onSelect(check),
    icon("target"),
    el("span", { class: "spoken" }, `${check.words}, worst: `),
    el("span", {}, when),
    isolated(worst.words),
  );
}

export class Requirements {
  readonly element = el("div", { class: "requirements" });
  readonly #rows = new Map<Check, HTMLElement>();
  readonly #onSelect: (check: Check) => void;

  constructor(view: View, onSelect: (check: Check) => void) {
    this.#onSelect = onSelect;
    this.replace(view);
  }

  /** Shows those of another document. */
  replace(view: View): void {
    this.#rows.clear();
    this.element.replaceChildren();
    if (view.certificate === null) this.#without(view);
    else this.#table(view, view.certificate);
  }

  /** Marks the requirement whose worst place is shown. */
  mark(check: Check | null): void {
    for (const [of, row] of this.#rows) row.classList.toggle("marked", of === check);
    if (check !== null) this.#rows.get(check)?.scrollIntoView({ block: "nearest" });
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
    this.element.append(el("p", { class: "summary" }, summary(certificate)));
    const checks = [...certificate.checks].sort((a, b) => RANK[a.status] - RANK[b.status]);
    const brief = checks.filter(isBrief);
    const rows = checks.filter((check) => !isBrief(check)).map((check) => this.#row(check));
    this.element.append(el("ul", { class: "checks" }, ...rows));
    if (certificate.contact !== null) this.element.append(...contactTable(view, certificate.contact));
    if (brief.length === 0) return;
    const items = brief.map((check) => el("li", {}, toneIcon("proved"), check.words));
    this.element.append(el("h3", { class: "brief-title" }, "Proved, with nothing to measure"), el("ul", { class: "brief" }, ...items));
  }

  #row(check: Check): HTMLElement {
    const row = el(
      "li",
      { class: `check tone-${check.status}` },
      statusCell(check.status),
      el("span", { class: "requirement" }, check.words),
      check.detail === "" ? null : el("span", { class: "detail" }, isolated(check.detail)),
      worstButton(check, this.#onSelect),
    );
    this.#rows.set(check, row);
    return row;
  }
}

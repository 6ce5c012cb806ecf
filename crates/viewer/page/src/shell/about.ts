/** What the verdict rests on, what is proved and what is only shown, and whose work is in the page. */
import type { View } from "../view.ts";
import { el, isolated } from "./dom.ts";
import { keyTable } from "./keys.ts";

function restsOn(view: View): HTMLElement | null {
  const lines = view.certificate?.rests_on ?? [];
  if (lines.length === 0) return null;
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

/** Elements and icons. Text gets into the page as text, never as HTML. */
import type { Tone } from "../verdict.ts";

export type Child = Node | string | null;

export interface Properties {
  class?: string;
  id?: string;
  title?: string;
  /** Attributes; null leaves one out. */
  set?: Record<string, string | number | null>;
}

function fill<E extends Element>(element: E, properties: Properties, children: readonly Child[]): E {
  if (properties.class !== undefined) element.setAttribute("class", properties.class);
  if (properties.id !== undefined) element.id = properties.id;
  if (properties.title !== undefined) element.setAttribute("title", properties.title);
  for (const [name, value] of Object.entries(properties.set ?? {})) {
    if (value !== null) element.setAttribute(name, String(value));
  }
  element.append(...children.filter((child) => child !== null));
  return element;
}

export function el<K extends keyof HTMLElementTagNameMap>(
  tag: K,
  properties: Properties = {},
  ...children: Child[]
): HTMLElementTagNameMap[K] {
  return fill(document.createElement(tag), properties, children);
}

const SVG = "http://www.w3.org/2000/svg";

export function svg<K extends keyof SVGElementTagNameMap>(
  tag: K,
  properties: Properties = {},
  ...children: Child[]
): SVGElementTagNameMap[K] {
  return fill(document.createElementNS(SVG, tag), properties, children);
}

/** A button; `label` is read out and shown as a tooltip where the button has no text of its own. */
export function button(
  properties: Properties & { label?: string },
  onClick: () => void,
  ...children: Child[]
): HTMLButtonElement {
  const { label, ...rest } = properties;
  const set = { type: "button", ...rest.set, ...(label === undefined ? {} : { "aria-label": label }) };
  const element = el("button", { ...(label === undefined ? {} : { title: label }), ...rest, set }, ...children);
  element.addEventListener("click", onClick);
  return element;
}

/** Text of a document in whatever direction it runs, kept from turning its surroundings. */
export function isolated(text: string, properties: Properties = {}): HTMLElement {
  return el("bdi", properties, text);
}

/** The element of the template with this id. */
export function byId(id: string): HTMLElement {
  const element = document.getElementById(id);
  if (element === null) throw new Error(`the template has no #${id}`);
  return element;
}

/** Changes a text only where it differs: the browser lays out again whatever is set. */
export class TextCell {
  readonly node: Text;
  #value: string;

  constructor(value = "") {
    this.#value = value;
    this.node = document.createTextNode(value);
  }

  set(value: string): void {
    if (value === this.#value) return;
    this.#value = value;
    this.node.data = value;
  }
}

/** Tells screen readers: few words, not every frame. */
export function announce(words: string): void {
  byId("announcer").textContent = words;
}

/** The way from `root` down to an element, by places among siblings; null where it is not within. */
function wayTo(root: Element, element: Element | null): number[] | null {
  const way: number[] = [];
  for (let at = element; at !== root; at = at.parentElement) {
    if (at?.parentElement == null) return null;
    way.unshift([...at.parentElement.children].indexOf(at));
  }
  return way;
}

/** Calls `renew`; focus that this takes away goes to the element of the same kind in the same place. */
export function keepingFocus(root: Element, renew: () => void): void {
  const focused = document.activeElement;
  const way = wayTo(root, focused);
  const { scrollTop } = root;
  renew();
  if (root.scrollTop !== scrollTop) root.scrollTop = scrollTop;
  if (way === null || focused === null || focused.isConnected) return;
  let at: Element | undefined = root;
  for (const k of way) at = at?.children[k];
  if (at instanceof HTMLElement && at.tagName === focused.tagName) at.focus({ preventScroll: true });
}

const PATHS = {
  play: "M7 4.5v15l12-7.5z",
  pause: "M8 5v14M16 5v14",
  first: "M18 5v14l-10-7zM6 5v14",
  previous: "M15 5l-7 7 7 7",
  next: "M9 5l7 7-7 7",
  check: "M5 12.5l4.5 4.5L19 7.5",
  cross: "M6.5 6.5l11 11M17.5 6.5l-11 11",
  question: "M8.5 9a3.5 3.5 0 1 1 5.2 3.1c-1.2.7-1.7 1.3-1.7 2.6M12 18.2v.3",
  tilde: "M5 13.5c2.2-4.6 4.9-4.2 7-1.5s4.800 3.100 7-1.500",
  dash: "M6 12h12",
  sun: "M12 8a4 4 0 1 0 0 8 4 4 0 0 0 0-8zM12 2.500v2M12 19.500v2M2.500 12h2M19.500 12h2M5.300 5.300l1.400 1.400M17.300 17.300l1.400 1.400M18.700 5.300l-1.400 1.400M6.700 17.300l-1.400 1.400",
  moon: "M20 14.500A8.500 8.500 0 0 1 9.500 4 8.500 8.500 0 1 0 20 14.500z",
  fullscreen: "M4 9V4h5M20 9V4h-5M4 15v5h5M20 15v5h-5",
  camera: "M3 8.500h4l1.500-2.500h7L17 8.500h4v10H3zM12 10.500a3 3 0 1 0 0 6 3 3 0 0 0 0-6z",
  layers: "M12 4l9 5-9 5-9-5zM3.500 13.500L12 18.200l8.500-4.700",
  copy: "M9 9h10v11H9zM15 9V4H5v11h4",
  target: "M12 5a7 7 0 1 0 0 14 7 7 0 0 0 0-14zM12 2v5M12 17v5M2 12h5M17 12h5",
  undo: "M8.500 5L4 9.500 8.500 14M4.500 9.500H14a5 5 0 0 1 0 10h-3",
  redo: "M15.500 5L20 9.500 15.500 14M19.500 9.500H10a5 5 0 0 0 0 10h3",
  down: "M6 9.500l6 6 6-6",
} as const;

export type IconName = keyof typeof PATHS;

const FILLED: ReadonlySet<IconName> = new Set(["play", "first"]);

/** An icon that says nothing by itself. */
export function icon(name: IconName): SVGSVGElement {
  const path = svg("path", { set: { d: PATHS[name] } });
  return svg("svg", { class: FILLED.has(name) ? "icon icon-filled" : "icon", set: { viewBox: "0 0 24 24", "aria-hidden": "true" } }, path);
}

const TONES: Record<Tone, IconName> = { proved: "check", violated: "cross", not_proved: "question", waived: "tilde", none: "dash" };

/** The sign of a verdict: told apart by its shape, whatever its colour. */
export function toneIcon(tone: Tone): SVGSVGElement {
  return icon(TONES[tone]);
}

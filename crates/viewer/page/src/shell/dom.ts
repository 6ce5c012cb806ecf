/** Elements. Text gets into the page as text, never as HTML. */

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

/** Controls for the values of keys, by their domain. */
import { el } from "../shell/dom.ts";
import { stepped, valueText } from "./domain.ts";
import type { Key, Value } from "./protocol.ts";

export interface Control {
  readonly element: HTMLInputElement | HTMLSelectElement | HTMLTextAreaElement;
  /** What is in it, as `readValue` reads it. */
  read(): string;
  /** Shows what the text states, or what counts without it. */
  show(stated: Value | undefined, counts: Value | undefined): void;
}

export interface ControlActions {
  /** What is typed has changed. */
  typed(): void;
  /** It is meant. */
  commit(): void;
  /** It is not. */
  revert(): void;
}

export function controlFor(key: Key, actions: ControlActions): Control {
  switch (key.domain.kind) {
    case "word":
      return select(key.domain.words, actions);
    case "bool":
      return checkbox(actions);
    case "points":
    case "paths":
      return area(key, actions);
    default:
      return field(key, actions);
  }
}

function select(words: readonly string[], actions: ControlActions): Control {
  const none = el("option", { set: { value: "" } }, "–");
  const element = el("select", {}, none, ...words.map((word) => el("option", { set: { value: word } }, word)));
  element.addEventListener("change", () => (element.value === "" ? actions.revert() : actions.commit()));
  return {
    element,
    read: () => element.value,
    show: (stated, counts) => {
      none.hidden = counts !== undefined;
      element.value = String(stated ?? counts ?? "");
    },
  };
}

function checkbox(actions: ControlActions): Control {
  const element = el("input", { set: { type: "checkbox" } });
  element.addEventListener("change", () => actions.commit());
  return {
    element,
    read: () => String(element.checked),
    show: (stated, counts) => {
      element.checked = (stated ?? counts) === true;
    },
  };
}

function area(key: Key, actions: ControlActions): Control {
  const element = el("textarea", { set: { rows: 3, spellcheck: "false", autocomplete: "off", wrap: "off" } });
  const text = (value: Value): string => (Array.isArray(value) ? value.map((one: Value) => valueText(one)).join("\n") : valueText(value));
  element.addEventListener("input", () => actions.typed());
  element.addEventListener("change", () => actions.commit());
  element.addEventListener("keydown", (event) => {
    if (event.key === "Enter" && (event.ctrlKey || event.metaKey)) actions.commit();
    if (event.key === "Escape") actions.revert();
  });
  element.title = key.domain.kind === "points" ? "A line a pair: x, y of a plate, or radius and slope of a knot" : "A line a folder";
  return {
    element,
    read: () => element.value,
    show: (stated, counts) => {
      element.value = stated === undefined ? "" : text(stated);
      element.placeholder = counts === undefined ? "" : text(counts);
      element.rows = Math.max(2, Math.min(8, element.value.split("\n").length));
    },
  };
}

/** Numbers of joints are typed in one field, with commas between: so they are copied, too. */
function field(key: Key, actions: ControlActions): Control {
  const { domain } = key;
  const numeric = domain.kind === "integer" || domain.kind === "number" || domain.kind === "number_above";
  const element = el("input", { set: { type: "text", inputmode: numeric ? "decimal" : "text", spellcheck: "false", autocomplete: "off" } });
  element.addEventListener("input", () => actions.typed());
  element.addEventListener("change", () => actions.commit());
  element.addEventListener("keydown", (event) => {
    if (event.key === "Enter") actions.commit();
    if (event.key === "Escape") actions.revert();
    if (!numeric || (event.key !== "ArrowUp" && event.key !== "ArrowDown")) return;
    event.preventDefault();
    const next = stepped(element.value === "" ? element.placeholder : element.value, event.key === "ArrowUp" ? 1 : -1, event.shiftKey, domain);
    if (next === null) return;
    element.value = next;
    actions.typed();
    actions.commit();
  });
  return {
    element,
    read: () => element.value,
    show: (stated, counts) => {
      const text = stated === undefined ? "" : valueText(stated);
      if (element.value !== text) element.value = text;
      element.placeholder = counts === undefined ? "none" : valueText(counts);
    },
  };
}

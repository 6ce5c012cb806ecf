/** The documents that stand in the page: a plan, and the live cell where there is one. */
import type { EditDocument } from "./edit/protocol.ts";
import type { View } from "./view.ts";

const VIEW = "platewash-view/2";
const EDIT = "platewash-edit/1";
const NO_PLAN = "This page holds no plan. Write one with “platewash run”.";

/** Why there is nothing to show. */
export class DocumentError extends Error {
  override name = "DocumentError";
}

function isObject(value: unknown): value is Record<string, unknown> {
  return typeof value === "object" && value !== null && !Array.isArray(value);
}

function parsed(text: string, what: string, remedy: string): unknown {
  try {
    return JSON.parse(text);
  } catch {
    throw new DocumentError(`The ${what} in this page cannot be read: the file is damaged. ${remedy}`);
  }
}

/** What the text holds. Its format is checked; what it holds beyond that is platewash's own word. */
export function parseView(text: string): View {
  const view = parsed(text, "plan", "Write it again with “platewash run”.");
  if (!isObject(view)) throw new DocumentError(NO_PLAN);
  if (view["format"] !== VIEW) {
    const found = typeof view["format"] === "string" ? `“${view["format"].slice(0, 40)}”` : "none";
    throw new DocumentError(`The plan in this page has another format than this page reads: ${found} instead of “${VIEW}”.`);
  }
  return view as unknown as View;
}

/** The document of this page. */
export function readView(page: Document): View {
  const element = page.getElementById("platewash-view");
  if (element === null) throw new DocumentError(NO_PLAN);
  return parseView(element.textContent ?? "");
}

/** The block of a live cell; null in a page that only shows. */
export function readEdit(page: Document): EditDocument | null {
  const text = page.getElementById("platewash-edit")?.textContent ?? null;
  if (text === null) return null;
  const edit = parsed(text, "live cell", "Open it again with “platewash edit”.") as Partial<EditDocument> | null;
  if (edit?.format !== EDIT || typeof edit.text !== "string" || !Array.isArray(edit.keys)) {
    throw new DocumentError(`The live cell in this page has another format than this page reads: it is not “${EDIT}”.`);
  }
  return edit as EditDocument;
}

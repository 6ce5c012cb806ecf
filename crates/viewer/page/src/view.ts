/**
 * What a page shows, the document `platewash-view/2`, and how it is read. Its types come from Rust, `crates/viewer/src/view`.
 *
 * Units are SI and radians. World, arm base and plate frames are three things: `mount` is `T_world_base`, a plate's `pose` is
 * `T_world_plate`. Everything that is drawn is in the world frame unless it says otherwise.
 */
import type { EditDocument, Body as LinkBody, Shape as LinkShape, ObstacleShape, View } from "./protocols.ts";

export type * from "./protocols.ts";

/** A shape of a link, of a tool, or of what stands around. */
export type Shape = LinkShape | ObstacleShape;

/** One of them somewhere; colours are of links alone. */
export type Body = { shape: Shape } & Pick<LinkBody, "pose"> & Partial<Pick<LinkBody, "rgba">>;

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

/** What the text holds. */
export function parseView(text: string): View {
  return checkedView(parsed(text, "plan", "Write it again with “platewash run”."));
}

/** A document. Its format is checked; what it holds beyond that is platewash's own word. */
export function checkedView(view: unknown): View {
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
  return text === null ? null : checkedEdit(parsed(text, "live cell", "Open it again with “platewash edit”."));
}

/** A block of a live cell, its format checked. */
export function checkedEdit(block: unknown): EditDocument {
  const edit = block as Partial<EditDocument> | null;
  if (edit?.format !== EDIT || typeof edit.text !== "string" || !Array.isArray(edit.keys)) {
    throw new DocumentError(`The live cell in this page has another format than this page reads: it is not “${EDIT}”.`);
  }
  return edit as EditDocument;
}

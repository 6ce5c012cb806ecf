/** The block of a live cell in the page. */
import { DocumentError } from "../document.ts";
import type { EditDocument } from "./protocol.ts";

const FORMAT = "platewash-edit/1";

/** Reads the block; null in a page that only shows. */
export function readEdit(page: Document): EditDocument | null {
  const text = page.getElementById("platewash-edit")?.textContent ?? null;
  if (text === null) return null;
  let parsed: Partial<EditDocument> | null = null;
  try {
    parsed = JSON.parse(text) as Partial<EditDocument> | null;
  } catch {
    throw new DocumentError("The live cell in this page cannot be read: the file is damaged. Open it again with “platewash edit”.");
  }
  if (parsed?.format !== FORMAT || typeof parsed.text !== "string" || !Array.isArray(parsed.keys)) {
    throw new DocumentError(`The live cell in this page has another format than this page reads: it is not “${FORMAT}”.`);
  }
  return parsed as EditDocument;
}

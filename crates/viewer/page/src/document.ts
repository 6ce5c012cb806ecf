/** The document that stands in the page. */
import type { View } from "./view.ts";

const FORMAT = "platewash-view/1";

/** Why there is nothing to show. */
export class DocumentError extends Error {
  override name = "DocumentError";
}

function isObject(value: unknown): value is Record<string, unknown> {
  return typeof value === "object" && value !== null && !Array.isArray(value);
}

/** What the text holds. Its format is checked; what it holds beyond that is platewash's own word. */
export function parseView(text: string): View {
  let parsed: unknown;
  try {
    parsed = JSON.parse(text);
  } catch {
    throw new DocumentError("The plan in this page cannot be read: the file is damaged. Write it again with “platewash run”.");
  }
  if (!isObject(parsed)) throw new DocumentError("This page holds no plan. Write one with “platewash run”.");
  if (parsed["format"] !== FORMAT) {
    const found = typeof parsed["format"] === "string" ? `“${parsed["format"].slice(0, 40)}”` : "none";
    throw new DocumentError(`The plan in this page has another format than this page reads: ${found} instead of “${FORMAT}”.`);
  }
  return parsed as unknown as View;
}

/** The document of this page. */
export function readView(page: Document): View {
  const element = page.getElementById("platewash-view");
  if (element === null) throw new DocumentError("This page holds no plan. Write one with “platewash run”.");
  return parseView(element.textContent ?? "");
}

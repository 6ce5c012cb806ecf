/** Links to a scenario: `#scenario=rack` for a shipped one, `#cell=…` with the text of any other, compressed. */

/** Entries of the page's address that say which scenario it shows. */
export type CellLink = { scenario: string } | { cell: string };

/** Longest text of a scenario that platewash reads [bytes]. */
export const MOST_BYTES = 1 << 20;

/** Reason that a link has no scenario. */
export class LinkError extends Error {
  override name = "LinkError";
}

/** The scenario that an address names; null where it names none. */
export function linkedCell(hash: string): CellLink | null {
  const entries = new URLSearchParams(hash.replace(/^#/, ""));
  const cell = entries.get("cell");
  const scenario = entries.get("scenario");
  if (cell !== null) return { cell };
  return scenario === null ? null : { scenario };
}

/** Bytes as base64 that needs no escapes in an address. */
function toBase64(bytes: Uint8Array): string {
  let text = "";
  for (const byte of bytes) text += String.fromCharCode(byte);
  return btoa(text).replaceAll("+", "-").replaceAll("/", "_").replace(/=+$/, "");
}

function fromBase64(text: string): Uint8Array<ArrayBuffer> {
  return Uint8Array.from(atob(text.replaceAll("-", "+").replaceAll("_", "/")), (sign) => sign.charCodeAt(0));
}

async function collected(stream: ReadableStream<Uint8Array>, most: number): Promise<Uint8Array<ArrayBuffer>> {
  const parts: Uint8Array[] = [];
  let bytes = 0;
  const reader = stream.getReader();
  for (let next = await reader.read(); !next.done; next = await reader.read()) {
    bytes += next.value.length;
    if (bytes > most) {
      await reader.cancel();
      throw new LinkError("The scenario in this link is longer than 1 MiB, the most that platewash reads.");
    }
    parts.push(next.value);
  }
  const whole = new Uint8Array(bytes);
  let at = 0;
  for (const part of parts) {
    whole.set(part, at);
    at += part.length;
  }
  return whole;
}

function through(bytes: Uint8Array<ArrayBuffer>, change: CompressionStream | DecompressionStream): ReadableStream<Uint8Array> {
  return new Blob([bytes]).stream().pipeThrough(change);
}

/** A text for a link. */
export async function packed(text: string): Promise<string> {
  return toBase64(await collected(through(new TextEncoder().encode(text), new CompressionStream("deflate-raw")), Infinity));
}

/** The text of a link. `LinkError` where it holds none. */
export async function unpacked(cell: string): Promise<string> {
  try {
    const bytes = await collected(through(fromBase64(cell), new DecompressionStream("deflate-raw")), MOST_BYTES);
    return new TextDecoder("utf-8", { fatal: true }).decode(bytes);
  } catch (error) {
    if (error instanceof LinkError) throw error;
    throw new LinkError("The scenario in this link cannot be read: the link is damaged or was cut off.");
  }
}

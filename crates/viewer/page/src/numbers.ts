/** Arrays of the document, base64 and little-endian, and places in ascending times. */
import type { Numbers } from "./view.ts";

/** The last of the ascending times that is not after `t`; 0 where all are. Tries `hint` and its neighbour first, as time runs on. */
export function indexBefore(times: ArrayLike<number>, count: number, t: number, hint: number): number {
  for (let k = hint; k <= hint + 1 && k + 1 < count; k++) {
    if (k >= 0 && times[k]! <= t && t < times[k + 1]!) return k;
  }
  let low = 0;
  let high = count;
  while (low < high) {
    const middle = (low + high) >>> 1;
    if (times[middle]! <= t) low = middle + 1;
    else high = middle;
  }
  return Math.max(0, low - 1);
}

export type Decoded = Float64Array | Float32Array | Uint16Array | Uint8Array;

/** An array that is not what the document says it is. */
export class NumbersError extends Error {
  override name = "NumbersError";
}

const ARRAYS = { f64: Float64Array, f32: Float32Array, u16: Uint16Array, u8: Uint8Array } as const;
type Kind = keyof typeof ARRAYS;

function kindOf(numbers: Numbers): { kind: Kind; text: string } {
  for (const [kind, text] of Object.entries(numbers)) {
    if (kind in ARRAYS && typeof text === "string") return { kind: kind as Kind, text };
  }
  throw new NumbersError("array without numbers: expected one of f64, f32, u16, u8");
}

function bytesOf(text: string): Uint8Array {
  let binary: string;
  try {
    binary = atob(text);
  } catch {
    throw new NumbersError("array that is not base64");
  }
  const bytes = new Uint8Array(binary.length);
  for (let i = 0; i < binary.length; i++) bytes[i] = binary.charCodeAt(i);
  return bytes;
}

/** The numbers as they are stored; `NumbersError` where their count is not that of the shape. */
export function decode(numbers: Numbers): Decoded {
  const { kind, text } = kindOf(numbers);
  const bytes = bytesOf(text);
  const width = ARRAYS[kind].BYTES_PER_ELEMENT;
  const count = numbers.shape.reduce((product, n) => product * n, 1);
  if (bytes.length !== count * width) {
    throw new NumbersError(`array of shape ${numbers.shape.join("×")}: ${bytes.length} bytes instead of ${count * width}`);
  }
  return new ARRAYS[kind](bytes.buffer as ArrayBuffer);
}

/** The numbers in double precision. */
export function floats(numbers: Numbers): Float64Array {
  const decoded = decode(numbers);
  return decoded instanceof Float64Array ? decoded : Float64Array.from(decoded);
}

/** Triangles with an index: corners that are the same are stated once, and triangles without an area are left out. */
import { BufferAttribute, BufferGeometry } from "three";

/** A corner's place, normal and so on as bits, one after the other; -0 as 0. */
function cornersOf(names: readonly string[], geometry: BufferGeometry): { words: Uint32Array; width: number; count: number } {
  const attributes = names.map((name) => geometry.getAttribute(name));
  const width = attributes.reduce((sum, { itemSize }) => sum + itemSize, 0);
  const count = geometry.getAttribute("position").count;
  const floats = new Float32Array(width * count);
  let offset = 0;
  for (const attribute of attributes) {
    const { itemSize, array } = attribute;
    for (let i = 0; i < count; i++) for (let k = 0; k < itemSize; k++) floats[width * i + offset + k] = array[itemSize * i + k]! + 0;
    offset += itemSize;
  }
  return { words: new Uint32Array(floats.buffer), width, count };
}

/** For each corner the first one that is the same. */
function firstOf(words: Uint32Array, width: number, count: number): Uint32Array {
  const size = 2 ** Math.ceil(Math.log2(2 * count + 1));
  const table = new Int32Array(size).fill(-1);
  const first = new Uint32Array(count);
  for (let i = 0; i < count; i++) {
    let hash = 0;
    for (let k = 0; k < width; k++) hash = Math.imul(hash ^ words[width * i + k]!, 0x9e3779b1) ^ (hash >>> 15);
    let slot = (hash ^ (hash >>> 16)) & (size - 1);
    for (let other = table[slot]!; other >= 0; other = table[slot]!) {
      let k = 0;
      while (k < width && words[width * i + k] === words[width * other + k]) k++;
      if (k === width) break;
      slot = (slot + 1) & (size - 1);
    }
    if (table[slot]! < 0) table[slot] = i;
    first[i] = table[slot]!;
  }
  return first;
}

/** The same triangles with an index; a geometry without places as it is. Its attributes are of floats, and no other groups of it matter. */
export function indexed(geometry: BufferGeometry): BufferGeometry {
  const names = Object.keys(geometry.attributes);
  if (!names.includes("position")) return geometry;
  const { words, width, count } = cornersOf(names, geometry);
  const first = firstOf(words, width, count);
  const index = geometry.index;
  const corner = (at: number): number => first[index === null ? at : index.getX(at)]!;
  const number = new Int32Array(count).fill(-1);
  const kept: number[] = [];
  const triangles: number[] = [];
  const take = (at: number): number => {
    if (number[at]! < 0) number[at] = kept.push(at) - 1;
    return number[at]!;
  };
  for (let at = 0; at + 2 < (index?.count ?? count); at += 3) {
    const [a, b, c] = [corner(at), corner(at + 1), corner(at + 2)];
    if (a !== b && b !== c && c !== a) triangles.push(take(a), take(b), take(c));
  }
  const slim = new BufferGeometry();
  for (const name of names) {
    const { itemSize, array } = geometry.getAttribute(name);
    const values = new Float32Array(itemSize * kept.length);
    kept.forEach((at, i) => {
      for (let k = 0; k < itemSize; k++) values[itemSize * i + k] = array[itemSize * at + k]!;
    });
    slim.setAttribute(name, new BufferAttribute(values, itemSize));
  }
  slim.setIndex(triangles);
  return slim;
}

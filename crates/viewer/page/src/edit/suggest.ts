/** Words that were meant, perhaps. */

/** How many letters have to be put in, left out, changed or swapped with their neighbour. */
export function distance(a: string, b: string): number {
  const width = b.length + 1;
  let [before, last] = [new Array<number>(width).fill(0), Array.from({ length: width }, (_, k) => k)];
  for (let i = 1; i <= a.length; i++) {
    const row = new Array<number>(width).fill(i);
    for (let j = 1; j < width; j++) {
      const same = a[i - 1] === b[j - 1];
      row[j] = Math.min(last[j]! + 1, row[j - 1]! + 1, last[j - 1]! + (same ? 0 : 1));
      if (i > 1 && j > 1 && a[i - 1] === b[j - 2] && a[i - 2] === b[j - 1]) row[j] = Math.min(row[j]!, before[j - 2]! + 1);
    }
    [before, last] = [last, row];
  }
  return last[width - 1]!;
}

/** How far what was typed is from a key: from the whole of it, its name, or a part of that. */
function farFrom(typed: string, key: string): number {
  const name = key.slice(key.lastIndexOf(".") + 1);
  return Math.min(...[key, name, ...key.split(/[._]/)].map((part) => distance(typed, part) + (part === key || part === name ? 0 : 0.5)));
}

/** The keys that were meant, perhaps: the nearest first, none where all are far. */
export function suggestions(typed: string, keys: readonly string[], most = 3): string[] {
  const word = typed.trim().toLowerCase().slice(0, 60);
  if (word === "") return [];
  const near = keys.map((key) => ({ key, far: farFrom(word, key) })).filter(({ far }) => far <= Math.max(1, 0.4 * word.length));
  return near.sort((a, b) => a.far - b.far || (a.key < b.key ? -1 : 1)).slice(0, most).map(({ key }) => key);
}

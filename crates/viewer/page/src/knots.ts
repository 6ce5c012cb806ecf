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

/** What an arm did: samples that are interpolated between, and that may grow while a run is live. */
import { AXES } from "./motion.ts";
import { floats, indexBefore } from "./numbers.ts";
import type { Execution } from "./view.ts";

/** Numbers of one live sample: time, six positions, six speeds, six torques, error. */
export const LIVE_COLUMNS = 20;

/** A list of numbers that grows by doubling. */
class Column {
  #values: Float64Array;
  #length = 0;

  constructor(values: Float64Array) {
    this.#values = values;
    this.#length = values.length;
  }

  get length(): number {
    return this.#length;
  }

  /** All that there is room for; only the first `length` count. */
  get raw(): Float64Array {
    return this.#values;
  }

  view(): Float64Array {
    return this.#values.subarray(0, this.#length);
  }

  push(value: number): void {
    if (this.#length === this.#values.length) {
      const more = new Float64Array(Math.max(64, 2 * this.#length));
      more.set(this.#values);
      this.#values = more;
    }
    this.#values[this.#length++] = value;
  }
}

function column(numbers: Parameters<typeof floats>[0] | null): Column {
  return new Column(numbers === null ? new Float64Array(0) : floats(numbers));
}

/** Samples of an executed motion, in order of time. */
export class Recording {
  readonly #t: Column;
  readonly #q: Column;
  readonly #torque: Column;
  readonly #error: Column;
  #hint = 0;

  constructor(execution: Pick<Execution, "t_s" | "q_rad" | "torque_n_m"> & { error_m: Execution["error_m"] | null }) {
    this.#t = column(execution.t_s);
    this.#q = column(execution.q_rad);
    this.#torque = column(execution.torque_n_m);
    this.#error = column(execution.error_m);
  }

  get count(): number {
    return this.#t.length;
  }

  /** Time of the last sample [s]; 0 without any. */
  get end(): number {
    return this.count === 0 ? 0 : this.#t.raw[this.count - 1]!;
  }

  get times(): Float64Array {
    return this.#t.view();
  }

  /** Positions, six a sample [rad]. */
  get positions(): Float64Array {
    return this.#q.view();
  }

  /** Torques, six a sample [N m]; empty where there are none. */
  get torques(): Float64Array {
    return this.#torque.view();
  }

  /** Distances of the tip from where the plan has it [m]. */
  get errors(): Float64Array {
    return this.#error.view();
  }

  /** Adds live samples that are newer than the last one. Rows that are no sample are left out. */
  append(rows: readonly (readonly number[])[]): void {
    for (const row of rows) {
      if (row.length !== LIVE_COLUMNS || !row.every(Number.isFinite)) continue;
      if (this.count > 0 && row[0]! <= this.end) continue;
      this.#t.push(row[0]!);
      for (let j = 0; j < AXES; j++) {
        this.#q.push(row[1 + j]!);
        this.#torque.push(row[1 + 2 * AXES + j]!);
      }
      this.#error.push(row[LIVE_COLUMNS - 1]!);
    }
  }

  /** Joint positions at `t` [s], linear between samples; false where there are none. */
  positionAt(t: number, into: Float64Array): boolean {
    const count = this.count;
    if (count === 0) return false;
    const times = this.#t.raw;
    this.#hint = indexBefore(times, count, t, this.#hint);
    const k = this.#hint;
    const next = Math.min(k + 1, count - 1);
    const span = times[next]! - times[k]!;
    const share = span > 0 ? Math.max(0, Math.min(1, (t - times[k]!) / span)) : 0;
    const q = this.#q.raw;
    for (let j = 0; j < AXES; j++) {
      const from = q[k * AXES + j]!;
      into[j] = from + (q[next * AXES + j]! - from) * share;
    }
    return true;
  }

  /** The sample at or before `t`; -1 where there are none. */
  sampleAt(t: number): number {
    if (this.count === 0) return -1;
    this.#hint = indexBefore(this.#t.raw, this.count, t, this.#hint);
    return this.#hint;
  }

  /** Distance of the tip from the plan at sample `k` [m]. */
  errorOf(k: number): number {
    return this.#error.raw[k] ?? Number.NaN;
  }
}

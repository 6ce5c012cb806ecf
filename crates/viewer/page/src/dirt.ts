/** Dirt on the plates: when the certificate proves the dose at each place of a raster. */
import { timeOf } from "./coverage.ts";
import { decode, NumbersError } from "./numbers.ts";
import type { PlateDirt, View } from "./view.ts";

/** When each cell is clean [s]; below 0 where its middle is beyond the rim. `NumbersError` where the raster is none. */
export function cleanTimes({ clean, step_s }: PlateDirt): Float32Array {
  const steps = decode(clean);
  if (!(steps instanceof Uint16Array)) throw new NumbersError("dirt: clean must be u16");
  return Float32Array.from(steps, (step) => timeOf(step, step_s));
}

const SORTED = new WeakMap<PlateDirt, Float32Array>();

/** Share of a plate that is proved clean at `t` [s], by its raster but never more than is proved of it; null where no dose is proved. */
export function cleanShare(view: View, plate: number, t: number): number | null {
  const dirt = view.dirt.find((one) => one.plate === plate);
  if (dirt === undefined) return null;
  const times = SORTED.get(dirt) ?? cleanTimes(dirt).filter((time) => time >= 0).sort();
  SORTED.set(dirt, times);
  const later = times.findIndex((time) => time > t);
  const share = times.length === 0 ? 0 : (later < 0 ? times.length : later) / times.length;
  const proved = view.certificate?.contact?.plates.find((one) => one.plate === plate)?.dose.at_least ?? 0;
  return Math.min(share, proved);
}

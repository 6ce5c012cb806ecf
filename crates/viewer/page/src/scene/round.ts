/** How finely what is round is drawn: no chord farther off its arc than anybody sees. */

/** [m] */
const OFF_M = 0.00012;
const FEWEST = 16;

/** Segments round a circle: a multiple of four, so that it is as wide as it should be. */
export function segmentsRound(radius_m: number, most: number): number {
  if (!(radius_m > OFF_M)) return FEWEST;
  const enough = Math.PI / Math.acos(1 - OFF_M / radius_m);
  return Math.max(FEWEST, Math.min(most, 4 * Math.ceil(enough / 4)));
}

/** Segments of a quarter of a circle. */
export function segmentsOfQuarter(radius_m: number, most: number): number {
  if (!(radius_m > OFF_M)) return 1;
  return Math.max(1, Math.min(most, Math.ceil(Math.PI / 4 / Math.acos(1 - OFF_M / radius_m))));
}

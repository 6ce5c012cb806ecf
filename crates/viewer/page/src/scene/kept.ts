/** What of a scene stays as it is where another document takes the place of the one shown. */
import type { View } from "../view.ts";
import { marksHeight } from "./floor.ts";

/** True for what is kept. */
export interface Kept {
  arm: boolean;
  tool: boolean;
  obstacles: boolean;
  /** The floor with base circle and region. */
  floor: boolean;
  /** Where plates lie and what they look like; coverage apart. */
  plates: boolean;
  planned: boolean;
  executed: boolean;
  /** All ways of the tip. */
  paths: boolean;
  /** What the camera has to show. */
  extent: boolean;
}

/** Whether two parts of documents say the same; whole arms and motions are not compared but by identity. */
function same(a: unknown, b: unknown): boolean {
  return a === b || JSON.stringify(a) === JSON.stringify(b);
}

/** Arrays made anew without anything in them are the same, too. */
function sameList(a: readonly unknown[], b: readonly unknown[]): boolean {
  return a === b || (a.length === 0 && b.length === 0);
}

/** Compares two documents; arms, motions, paths and coverage by identity, the rest by what it says. */
export function keptOf(before: View, after: View): Kept {
  const arm = before.arm === after.arm;
  const tool = same(before.tool, after.tool);
  const obstacles = same(before.surroundings.obstacles, after.surroundings.obstacles);
  const plates = same(before.plates, after.plates);
  const motion = before.motion === after.motion && (after.motion === null || sameList(before.segments, after.segments));
  const execution = before.execution === after.execution;
  return {
    arm,
    tool,
    obstacles,
    floor:
      same(before.arm.mount, after.arm.mount) &&
      before.surroundings.base_circle_m === after.surroundings.base_circle_m &&
      same(before.surroundings.region_m, after.surroundings.region_m) &&
      marksHeight(before) === marksHeight(after),
    plates,
    planned: sameList(before.coverage, after.coverage),
    executed: execution,
    paths: arm && tool && plates && motion && execution && sameList(before.paths, after.paths),
    extent: arm && tool && obstacles && plates && motion && same(before.pose_rad, after.pose_rad),
  };
}

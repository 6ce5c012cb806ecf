/**
 * What a page shows: the document `platewash-view/2`, which `crates/viewer/src/view` writes.
 *
 * Units are SI and radians. World, arm base and plate frames are three things: `mount` is `T_world_base`, a plate's `pose` is
 * `T_world_plate`. Everything that is drawn is in the world frame unless it says otherwise.
 */
import type { EditDocument } from "./edit/protocol.ts";

/** `T_a_b`: where b's origin lies in a, and b's axes as a unit quaternion. */
export interface Pose {
  position_m: [number, number, number];
  quaternion_wxyz: [number, number, number, number];
}

/** An array of numbers, little-endian and in base64, row by row. */
export type Numbers = { shape: number[] } & ({ f64: string } | { f32: string } | { u16: string } | { u8: string });

/** A convex shape in its own frame. `cylinder` and `capsule` lie along z. */
export type Solid =
  | { box: { half_m: [number, number, number] } }
  | { cylinder: { radius_m: number; half_length_m: number } }
  | { sphere: { radius_m: number } }
  | { capsule: { radius_m: number; half_length_m: number } }
  | { hull: { points: [number, number, number][] } };

/** Of what stands around: all below z = 0, a convex shape, or the convex hulls of some lists of points. */
export type ObstacleShape = "half_space" | { convex: Solid } | { parts: [number, number, number][][] };

/** Triangles are [count, 3 corners, 3 coordinates]. */
export type Shape = Solid | ObstacleShape | { mesh: { triangles: Numbers } };

/** A shape somewhere. */
export interface Body {
  shape: Shape;
  pose: Pose;
  /** Red, green, blue, alpha from 0 to 1; of links alone, where they are stated. */
  rgba?: [number, number, number, number] | null;
}

/** What the page is about. */
export interface Heading {
  scenario: string;
  seed: number;
  /** SHA-256 of the plan; null for one configuration. */
  hash: string | null;
  /** Null for one configuration. */
  process: "wash" | "paper" | null;
  /** What must be read first of a dry run: nothing is washed; null for everything else. */
  dry_run: string | null;
  /** What the motion does to the plates. */
  treatment: "washed" | "swept" | "swept_in_air";
  robot: string;
  duration_s: number;
}

export type Status = "proved" | "violated" | "not_proved" | "waived";

/** A bound and its limit, SI units. */
export interface Measure {
  /** Null where nothing finite is proved. */
  bound: number | null;
  limit: number;
  /** Side of the limit on which the bound has to be. */
  sense: "at_most" | "at_least" | "above";
  unit: string;
}

/** A requirement and what came of it. */
export interface Check {
  /** The requirement's name in the certificate's file. */
  requirement: string;
  /** In words. */
  words: string;
  status: Status;
  /** Left out where there is nothing to measure. */
  measure?: Measure;
  /** Bound, seen and limit with units; the discrepancies; empty where there is nothing to add. */
  detail: string;
  /** Where it is worst: when, and in the world frame [m]. What does not apply is left out. */
  worst: { time_s?: number; place_m?: [number, number, number]; plate?: number };
  /** The rest of it in words: joint, plate, segment and pair. */
  place: string;
  why: Explanation;
}

/** A requirement in a sentence, where it is proved in the documentation, the numbers of its formulas, and whose its limit is. */
export interface Explanation {
  sentence: string;
  section: string;
  formulas: string[];
  /** Empty where nothing is measured. */
  limit: string;
}

/** The proof. */
export interface Certificate {
  passes: boolean;
  headline: string;
  /** Of the hash in the file. */
  hash: Status;
  checks: Check[];
  /** Of the contact with each plate; null where none is asked for. */
  contact: Contact | null;
  /** What the verdict rests on, a line each. */
  rests_on: string[];
}

/** What is asked of the contact with plates, and what is proved of it. */
export interface Contact {
  asked: ContactRequirements;
  /** In the order of washing. */
  plates: PlateContact[];
}

/** Lengths in m, forces in N; shares are of a face, by its area. */
export interface ContactRequirements {
  /** Least compression of the foam that counts. */
  compression_m: number;
  /** By how much a plate may lie higher or lower. */
  height_error_m: number;
  share: number;
  strain: number;
  force_n: [number, number];
  time_s: number;
  time_share: number;
  dose_pa_m: number;
  dose_share: number;
}

/** What is proved of the contact with a plate, in the words of the certificate. */
export interface PlateContact {
  plate: number;
  pressed: { at_least: number };
  time: { at_least: number };
  dose: { at_least: number };
  strain: { bound?: number };
  least_force_n: { bound?: number };
  greatest_force_n: { bound?: number };
  /** Of friction, at most: with the least and the greatest friction, which are assumptions. Left out where nothing is proved. */
  friction_torque_nm?: [number, number];
}

/** What counts as pressed: sampled on a raster, or proved. */
export interface Counted {
  compression_m: number;
  height_error_m: number;
  /** Whether the job asks for it; otherwise it is that the foam touches. */
  is_promised: boolean;
}

/** A joint: `T_parent_joint(q) = origin · Rot_z(q)`. */
export interface Joint {
  name: string;
  origin: Pose;
  /** Null where it turns without end. */
  position_rad: [number, number] | null;
  speed_rad_s: number;
  /** Null where the job states none. */
  acceleration_rad_s2: number | null;
}

/** A link, fixed to the frame behind `joints` joints: 0 for the base. */
export interface Link {
  joints: number;
  /** `T_frame_link`. */
  pose: Pose;
  /** Link frame. */
  visuals: Body[];
  /** Link frame: the bodies that count for the proof. */
  collision: Body[];
}

export interface Arm {
  name: string;
  /** `T_world_base`. */
  mount: Pose;
  joints: Joint[];
  links: Link[];
  /** `T_6_flange`: the mounting frame (`tool0`) behind joint 6. */
  flange: Pose;
}

export interface Tool {
  /** Flange frame; without the sponge. */
  bodies: Body[];
  sponge: { radius_m: number; height_m: number; compression_m: number; /** `T_flange_sponge`, its middle. */ pose: Pose };
  /** `T_flange_tip`: centre of the sponge's far face, z out of the tool. */
  tip: Pose;
}

export interface Surroundings {
  /** World frame. */
  obstacles: (Body & { name: string })[];
  /** Radius about the base axis that plates' centres keep away from [m]. */
  base_circle_m: number | null;
  /** Where plates' centres are drawn, a closed polygon seen from above [m]. */
  polygon_m: [number, number][] | null;
}

export interface Plate {
  name: string;
  /** `T_world_plate`: origin at the pole of the face, z out of the plate. */
  pose: Pose;
  /** The face's meridian from the pole to the rim: distance from the axis, height [m]. */
  meridian_m: [number, number][];
  thickness_m: number;
  /** What it stands on: a cylinder below the body under the pole. */
  foot?: { radius_m: number; height_m: number };
  /** Its own height error, soil and deviation in words, where it has any. */
  own?: string;
  /** What was measured of it. */
  relief?: Relief;
}

/** Heights of a plate on a polar grid, ring by ring, in steps of 10 µm over the pole; the azimuths begin at x. */
export interface Relief {
  radii_m: number[];
  azimuths: number;
  upper: number[];
  /** Empty where the underside was not measured. */
  lower: number[];
}

/** What the tip follows on a plate. */
export interface WashPath {
  plate: number;
  /** [n, 3], world frame [m]. */
  points_m: Numbers;
}

export type SegmentKind = "depart" | "approach" | "wash" | "retreat" | "transit" | "return";

export interface Segment {
  kind: SegmentKind;
  /** The plate washed, or the plate it leads to. */
  plate: number;
  t_start_s: number;
  t_end_s: number;
}

/** The planned motion: between two knots each joint is the cubic of their positions and speeds (Hermite). */
export interface Motion {
  /** [n], from 0. */
  t_s: Numbers;
  /** [n, 6] */
  q_rad: Numbers;
  /** [n, 6] */
  qd_rad_s: Numbers;
}

/** The smallest distance of all pairs that count, over time; sampled to look at, not the proof. */
export interface Clearance {
  margin_m: number;
  /** [n] */
  t_s: Numbers;
  /** [n] */
  distance_m: Numbers;
  /** [n, 2, 3]: the nearest point of either body, world frame. */
  nearest_m: Numbers;
  /** [n, 2]: indices into `names`. */
  pair: Numbers;
  names: string[];
}

/** How a plate gets swept, or pressed: a raster over the square around its face, sampled to look at, not the proof. */
export interface PlateCoverage {
  plate: number;
  /** Half of the square's edge [m]: the rim's radius. */
  half_m: number;
  /** What counts; null where the sponge has but to be over a place. */
  counted: Counted | null;
  /** [rows, columns], y then x ascending in the plate's frame: when the cell's middle first counts, in steps of
   * `step_s`; 65535 for never. Cells with their middle outside the rim are 65534. */
  first: Numbers;
  step_s: number;
  /** [rows, columns]: for how long it counts, in steps of `dwell_step_s`, at most 255. */
  dwell: Numbers;
  dwell_step_s: number;
  /** The share of what counts that the certificate proves at least; null without one. */
  proved: number | null;
}

/** Dirt on a plate: proved, unlike what is sampled of its coverage, at the middles of the raster's cells. */
export interface PlateDirt extends Pick<PlateCoverage, "plate" | "half_m" | "step_s"> {
  /** Dose that removes it [Pa·m]. */
  dose_pa_m: number;
  /** Name of the soil, where one is stated. */
  soil?: string;
  /** As `first` of the coverage: when the dose is proved there. */
  clean: Numbers;
}

/** What an arm did. */
export interface Execution {
  /** `simulated`, `recorded` (a CSV), or `live`: then the arrays are empty and the samples come from the server. */
  source: "simulated" | "recorded" | "live";
  /** Name of the control law; null where it is not known. */
  law: string | null;
  /** First line of its report. */
  headline: string | null;
  /** Whether every plate is washed; null where that is not judged. */
  washed: boolean | null;
  /** [n] */
  t_s: Numbers;
  /** [n, 6] */
  q_rad: Numbers;
  /** [n, 6] */
  qd_rad_s: Numbers;
  /** [n, 6] */
  qdd_rad_s2: Numbers | null;
  /** [n, 6]; null under a kinematic law. */
  torque_n_m: Numbers | null;
  /** Six limits; null where none are known. */
  torque_limit_n_m: number[] | null;
  /** [n]: distance of the tip from where the plan has it at that time [m]. */
  error_m: Numbers;
  coverage: PlateCoverage[];
}

/** What the paper's program makes of the same arm and plates. Nothing of it is proved. */
export interface Beside extends Pick<Execution, "t_s" | "q_rad" | "coverage"> {
  /** First line of its report. */
  headline: string;
  duration_s: number;
}

export interface View {
  format: "platewash-view/2";
  /** Of platewash. */
  version: string;
  heading: Heading;
  /** Null where nothing was proved. */
  certificate: Certificate | null;
  arm: Arm;
  tool: Tool | null;
  surroundings: Surroundings;
  plates: Plate[];
  /** In the order of washing. */
  paths: WashPath[];
  segments: Segment[];
  /** Null for one configuration. */
  motion: Motion | null;
  /** What the arm shows where there is no motion. */
  pose_rad: number[];
  clearance: Clearance | null;
  /** Of the planned motion. */
  coverage: PlateCoverage[];
  /** Empty where no dose is proved, and in a live cell. */
  dirt: PlateDirt[];
  execution: Execution | null;
  beside: Beside | null;
  /** Address of a live run's events; null where there is none. */
  live: string | null;
}

/**
 * Events of a live run, as the server sends them (server-sent events; `id` of `samples` is the index of its last sample, so
 * that a page that reconnects is told what it missed).
 *
 * `state`: a `LiveState`. `samples`: a `LiveSamples`. `done`: a `LiveEnd`.
 */
export interface LiveState {
  state: "waiting" | "running" | "done";
}

/** Rows of 20: t_s, six q_rad, six qd_rad_s, six torque_n_m (zeros under a kinematic law), error_m. */
export interface LiveSamples {
  samples: number[][];
}

export interface LiveEnd {
  /** The report's first line, or why there is none. */
  headline: string;
  washed: boolean | null;
}

const VIEW = "platewash-view/2";
const EDIT = "platewash-edit/1";
const NO_PLAN = "This page holds no plan. Write one with “platewash run”.";

/** Why there is nothing to show. */
export class DocumentError extends Error {
  override name = "DocumentError";
}

function isObject(value: unknown): value is Record<string, unknown> {
  return typeof value === "object" && value !== null && !Array.isArray(value);
}

function parsed(text: string, what: string, remedy: string): unknown {
  try {
    return JSON.parse(text);
  } catch {
    throw new DocumentError(`The ${what} in this page cannot be read: the file is damaged. ${remedy}`);
  }
}

/** What the text holds. */
export function parseView(text: string): View {
  return checkedView(parsed(text, "plan", "Write it again with “platewash run”."));
}

/** A document. Its format is checked; what it holds beyond that is platewash's own word. */
export function checkedView(view: unknown): View {
  if (!isObject(view)) throw new DocumentError(NO_PLAN);
  if (view["format"] !== VIEW) {
    const found = typeof view["format"] === "string" ? `“${view["format"].slice(0, 40)}”` : "none";
    throw new DocumentError(`The plan in this page has another format than this page reads: ${found} instead of “${VIEW}”.`);
  }
  return view as unknown as View;
}

/** The document of this page. */
export function readView(page: Document): View {
  const element = page.getElementById("platewash-view");
  if (element === null) throw new DocumentError(NO_PLAN);
  return parseView(element.textContent ?? "");
}

/** The block of a live cell; null in a page that only shows. */
export function readEdit(page: Document): EditDocument | null {
  const text = page.getElementById("platewash-edit")?.textContent ?? null;
  return text === null ? null : checkedEdit(parsed(text, "live cell", "Open it again with “platewash edit”."));
}

/** A block of a live cell, its format checked. */
export function checkedEdit(block: unknown): EditDocument {
  const edit = block as Partial<EditDocument> | null;
  if (edit?.format !== EDIT || typeof edit.text !== "string" || !Array.isArray(edit.keys)) {
    throw new DocumentError(`The live cell in this page has another format than this page reads: it is not “${EDIT}”.`);
  }
  return edit as EditDocument;
}

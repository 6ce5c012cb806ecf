/**
 * What the page of a live cell and whoever plans for it say to each other: `platewash-edit/1`. `crates/editor/src/protocol` states
 * the same.
 *
 * The page holds the scenario, as the text of its file; whoever plans holds nothing but files and what is being worked on. Each
 * question carries all that its answer needs. An answer is a stream of lines, each a JSON object with its `kind`. Units are SI.
 */
import type { Arm, Certificate, Motion, View } from "../view.ts";

/** A value of a scenario's key, as TOML has it. */
export type Value = string | number | boolean | readonly Value[] | Readonly<{ [name: string]: number }>;

/** What a key's value may be. */
export type Domain =
  | { kind: "text" | "path" | "paths" | "bool" }
  | { kind: "word"; words: string[] }
  | { kind: "integer" | "number" | "number_above" | "range" | "joints" | "joints_above" | "pair" | "pair_above" | "triple" | "triple_above" | "points" | "positions"; least: number; most: number };

/** A row of the table of keys. */
export interface Key {
  /** `wash.tilt_max_deg` */
  path: string;
  /** Empty where it has none. */
  unit: string;
  domain: Domain;
  /** The domain in words. */
  expected: string;
  meaning: string;
  /** Null where there is none. */
  default: Value | null;
}

/** The block `platewash-edit` in the page. */
export interface EditDocument {
  format: "platewash-edit/1";
  /** `server`: questions go to the page's own address; `frame`: to the window around it, by messages; `worker`: to workers of the browser. */
  channel: "server" | "frame" | "worker";
  /** Where it is saved, in words; null where it cannot be. */
  file: string | null;
  /** SHA-256 of what stands on disk there; null where there is nothing. */
  disk: string | null;
  /** That, where it is text. */
  saved: string | null;
  /** The scenario. */
  text: string;
  keys: Key[];
}

/** `POST /cell`: what the scenario with some changes looks like, planned and proved. */
export interface CellQuestion {
  /** Of the page: a question of one cancels those before it, of another none. At most 64 letters and digits. */
  session: string;
  /** The scenario. */
  text: string;
  /** Changes to it, in order; null takes a key out. */
  edits: { key: string; value: Value | null }[];
  /** How far to go. */
  want: "preview" | "proof";
  /** Id of the arm that the page has; null for none. */
  arm: string | null;
  /** Whether the page shows a guess already, so that none is made beside the plan. */
  guessed: boolean;
}

/** Milliseconds that steps took where they were done. */
export type Milliseconds = Record<string, number>;

export type Chance = "washable" | "unwashable" | "unclear";

/** A line behind which nothing follows. */
type LastLine =
  /** It is no scenario, or states no job. */
  | { kind: "refused"; words: string; key: string | null; line: number | null; ms: Milliseconds }
  /** A later question of the same page came. */
  | { kind: "superseded" }
  /** Too much work, or a fault of the program. */
  | { kind: "failed"; words: string };

/** Lines of the answer to `/cell`, in this order. */
export type CellLine =
  | LastLine
  | {
      kind: "scenario";
      /** The scenario with the changes, its comments and order kept. */
      text: string;
      /** What the text states. */
      stated: Record<string, Value>;
      /** What counts: defaults filled in; keys without a value are left out. */
      values: Record<string, Value>;
      ms: Milliseconds;
    }
  /** What there is before anything is planned. */
  | (Pick<View, "heading" | "tool" | "surroundings" | "plates" | "pose_rad"> & {
      kind: "cell";
      /** Null where the page has it already. */
      arm: { id: string; arm: Arm } | null;
      arm_id: string;
      /** Centres of the plates [m]. */
      centres_m: [number, number][];
      /** Radius of the plates [m], each. */
      radius_m: number[];
      /** Whether the text lists the plates, or they are drawn from a region. */
      listed: boolean;
      /** How plates and what stands around are moved. */
      moves: Moves;
      /** What is to be said about how plates lie. */
      findings: { words: string; plates: number[] }[];
      ms: Milliseconds;
    })
  /** A guess, plate by plate: not planned, not proved. */
  | { kind: "preview"; plates: { plate: number; chance: Chance; words: string }[]; ms: Milliseconds }
  /** Planned, not proved. */
  | (Pick<View, "heading" | "paths" | "segments" | "clearance" | "coverage"> & { kind: "plan"; headline: string; motion: Motion; ms: Milliseconds })
  /** No plan. */
  | {
      kind: "unplanned";
      headline: string;
      reason: string;
      /** Whether it is known that there is none, or none was found. */
      proved: boolean;
      plates: Unwashable[];
      ms: Milliseconds;
    }
  /** Where else a plate could lie; a line a plate behind `unplanned`. Null: nowhere within `searched_m`. */
  | { kind: "place"; plate: number; nearest_m: [number, number] | null; searched_m: number; ms: Milliseconds }
  /** Behind `plan`. */
  | { kind: "proof"; certificate: Certificate; headline: string; proved: { plate: number; at_least: number }[]; ms: Milliseconds };

/** How the things of a cell are moved. */
export interface Moves {
  plates: PlateMoves;
  /** Of each body of `surroundings.obstacles`. */
  bodies: BodyMove[];
}

/** What says where plates are: `layout.positions_m`, or a `[[plate]]` section each. */
export type PlateMoves =
  | { by: "positions" }
  /** `sections`: of each plate its section; `at_m`: of each section its place [m]. */
  | { by: "sections"; sections: number[]; at_m: [number, number, number][] }
  /** They are not moved, and why. */
  | { by: "nothing"; words: string };

/** What says where a body is that stands around. */
export interface BodyMove {
  /** Null where it is not moved. */
  key: string | null;
  /** Its value [m], x and y first. */
  at_m: number[];
  /** Why it is not moved. */
  words: string | null;
  /** The plates that it holds, by their index, with which it goes; null where it holds every plate. */
  holds: number[] | null;
}

/** A plate that cannot be washed, or that no way to wash was found for. */
export interface Unwashable {
  plate: number;
  /** Whether it is known that it cannot. */
  proved: boolean;
  words: string;
  /** What keeps parts of it from being washed, the most frequent first. */
  causes: string[];
  /** Share of its wash path for which configurations were found; null where that is not known. */
  share: number | null;
  /** Contact points, world frame [m]: those for which configurations were found, and those for which none were. */
  free_m: [number, number, number][];
  dead_m: [number, number, number][];
}

/** `POST /map`: where a plate could be washed, the others as they lie. Answered by `map` lines as they come, then `map_done`. */
export interface MapQuestion {
  session: string;
  text: string;
  plate: number;
}

export type MapLine =
  | LastLine
  /** Squares of edge `step_m`, coarse ones first: centre x and y [m]. */
  | { kind: "map"; step_m: number; washable_m: [number, number][]; unwashable_m: [number, number][]; done: number; of: number }
  | { kind: "map_done"; words: string; ms: Milliseconds };

/** `POST /recover`: the way on after a stop of the scenario's plan. One line. */
export interface RecoveryQuestion {
  session: string;
  text: string;
  /** Time in the plan [s]; null where it is not known. */
  stopped_s: number | null;
  /** Where the arm stands [deg]; null for where the plan has it then. */
  at_deg: number[] | null;
}

export type RecoveryLine =
  | LastLine
  /** `view`: the motion home, with its proof. `rest`: first line on the plates that are left; null where all were washed. */
  | { kind: "recovery"; proved: boolean; stop: string; rest: string | null; view: View; ms: Milliseconds };

/** `POST /save`: writes the scenario, and plan, report and page beside it. */
export interface SaveQuestion {
  session: string;
  text: string;
  /** SHA-256 of what the page takes to stand on disk; null for nothing. `force`: whatever stands there. */
  disk: string | null;
  force: boolean;
}

export type SaveLine =
  | { kind: "saved"; disk: string; file: string; files: string[]; words: string }
  /** Something else stands on disk. `text` is null where it cannot be read as text. */
  | { kind: "conflict"; disk: string | null; text: string | null; words: string }
  | { kind: "failed"; words: string };

/** `POST /disk`: asked every second or so. One line. */
export interface DiskQuestion {
  session: string;
  /** What the page knows. */
  disk: string | null;
}

/** `text` where it differs from what the page knows, null where it does not, or cannot be read (`words` says why). */
export type DiskLine = { kind: "disk"; disk: string | null; text: string | null; words: string | null };

/** `POST /hello`: what a page needs that was loaded from a server that is gone. One line. */
export type HelloLine = { kind: "hello"; format: string; file: string | null; disk: string | null };

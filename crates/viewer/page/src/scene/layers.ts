/** Layers: what of the scene can be shown or hidden by itself. */

/** What can be shown or hidden. */
export type Layer =
  | "arm" | "bodies" | "plates" | "coverage" | "paths" | "transits" | "executed" | "tip" | "clearance" | "region" | "obstacles" | "floor";

/** Their names on the page, in its order. */
export const LABELS: Record<Layer, string> = {
  arm: "Arm and tool",
  plates: "Plates",
  coverage: "What is swept of the plates",
  paths: "Wash paths",
  transits: "Transits",
  executed: "Executed path",
  tip: "Tip frame",
  clearance: "Smallest clearance",
  region: "Region and base circle",
  obstacles: "Obstacles",
  floor: "Floor",
  bodies: "Bodies of the proof",
};

export const LAYERS = Object.keys(LABELS) as Layer[];

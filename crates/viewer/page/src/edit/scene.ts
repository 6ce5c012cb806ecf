/** What a live cell asks of the scene. Where there is no scene, all of it is done to nothing. */
import type { Selected } from "./moves.ts";
import type { Centre } from "./placing.ts";
import type { Chance } from "./protocol.ts";

export type Phase = "start" | "drag" | "end" | "cancel";

/** What hands do in the scene. */
export interface Hands {
  select(plate: number | null): void;
  /** Centres of those plates, in their order. */
  move(to: { plates: number[]; centres_m: Centre[] }, phase: Phase): void;
  take(plate: number): void;
  /** Whether plates may be moved; says why not. */
  mayMove(): boolean;
  /** A body that stands around was clicked; null for none. */
  selectBody(body: number | null): void;
  moveBody(body: number, centre_m: Centre, phase: Phase): void;
}

export interface Offending {
  plate: number;
  free_m: [number, number, number][];
  dead_m: [number, number, number][];
}

export interface Patch {
  step_m: number;
  washable_m: [number, number][];
  unwashable_m: [number, number][];
}

export interface EditedScene {
  edit(hands: Hands): void;
  select(selected: Selected): void;
  preview(centres_m: Centre[] | null): void;
  /** The body that is selected among those that stand around. */
  selectBody(body: number | null): void;
  /** Shows a body elsewhere; null where it is. */
  previewBody(put: { body: number; centre_m: Centre } | null): void;
  chances(list: { plate: number; chance: Chance }[] | null): void;
  offending(list: Offending[]): void;
  ghosts(list: { plate: number; centre_m: [number, number] }[]): void;
  map(patch: Patch | null): void;
  /** Where a place on the canvas [CSS px] is in a level plane [m]; null where it is not in it. */
  toPlane(x: number, y: number, height_m: number): Centre | null;
}

const nothing = (): void => undefined;

/** In place of a scene that cannot be drawn. */
export const NO_SCENE: EditedScene = {
  edit: nothing,
  select: nothing,
  preview: nothing,
  selectBody: nothing,
  previewBody: nothing,
  chances: nothing,
  offending: nothing,
  ghosts: nothing,
  map: nothing,
  toPlane: () => null,
};

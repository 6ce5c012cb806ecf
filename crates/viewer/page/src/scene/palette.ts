/** The scene's colours. What means different things differs in lightness or form, too. */

import { palette, type Theme } from "../palette.ts";

export interface Palette {
  /** Background, above and below. */
  top: string;
  bottom: string;
  /** The 1 m × 1 m patch: grey 0.8 by day. */
  patch: string;
  grid: string;
  shadow: number;
  /** Share of the studio's light that comes from all round. */
  ambient: number;
  key: number;
  /** Ways of the tip, in the colours that they have on the whole page. */
  wash: string;
  transit: string;
  executed: string;
  region: string;
  clearance: string;
  tooNear: string;
  mark: string;
  commanded: string;
  body: string;
  obstacle: string;
  porcelain: string;
  washed: string;
  dirt: string;
  front: string;
  handle: string;
  sponge: string;
  /** Around what is selected, around what the pointer is over, and the ring that turns plates about the base axis. */
  selected: string;
  hovered: string;
  turn: string;
  /** What is said of plates before they are planned. */
  washable: string;
  unclear: string;
  unwashable: string;
  /** Discs of signs under white letters. */
  sign: { unclear: string; unwashable: string };
  /** A plate where it could be washed. */
  ghost: string;
  /** Squares of the map, apart in lightness, too. */
  mapWashable: string;
  mapUnwashable: string;
}

type Own = Omit<Palette, "wash" | "transit" | "executed">;

const LIGHT: Own = {
  top: "#f7f9fb",
  bottom: "#dfe5eb",
  patch: "#b3b5b8",
  grid: "#5b6b7c",
  shadow: 0.3,
  ambient: 1.0,
  key: 2.1,
  region: "#33475b",
  clearance: "#00735c",
  tooNear: "#d7261e",
  mark: "#d7261e",
  commanded: "#33475b",
  body: "#0072b2",
  obstacle: "#8796a5",
  porcelain: "#f4f5f4",
  washed: "#6fb7e0",
  dirt: "#8a6134",
  front: "#d8f1ff",
  handle: "#8d97a0",
  sponge: "#f0c23c",
  selected: "#005fb8",
  hovered: "#4d8fc9",
  turn: "#005fb8",
  washable: "#009e73",
  unclear: "#b57b00",
  unwashable: "#c8281e",
  sign: { unclear: "#8a5c00", unwashable: "#b3201a" },
  ghost: "#00a878",
  mapWashable: "#63d6c1",
  mapUnwashable: "#80504e",
};

const DARK: Own = {
  ...LIGHT,
  top: "#1c242d",
  bottom: "#0f141a",
  patch: "#59626b",
  grid: "#9fb0c0",
  shadow: 0.55,
  ambient: 0.62,
  key: 1.9,
  region: "#a9bccd",
  clearance: "#3fd6b0",
  tooNear: "#ff6a55",
  mark: "#ff6a55",
  commanded: "#dbe5ee",
  body: "#56b4e9",
  obstacle: "#71808f",
  porcelain: "#e6e8e8",
  washed: "#5fa9d6",
  dirt: "#7d5a31",
  handle: "#a3acb4",
  selected: "#7cc4ff",
  hovered: "#a9d3f2",
  turn: "#7cc4ff",
  washable: "#35c79b",
  unclear: "#f0bf4c",
  unwashable: "#ff5a45",
  ghost: "#35d6a2",
  mapWashable: "#4fc4b0",
  mapUnwashable: "#6d4443",
};

function withMeanings(own: Own, theme: Theme): Palette {
  const { segments, executed } = palette(theme);
  return { ...own, wash: segments.wash, transit: segments.transit, executed };
}

export const PALETTES: Record<Theme, Palette> = { light: withMeanings(LIGHT, "light"), dark: withMeanings(DARK, "dark") };

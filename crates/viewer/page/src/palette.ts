/**
 * Colours that mean something, for scene, scrubber and plots. Hues of Okabe and Ito's palette for all kinds of colour vision,
 * darkened or lightened for contrast with the ground; the wash path is magenta as in the paper.
 */
import type { SegmentKind, Status } from "./view.ts";

export type Theme = "light" | "dark";

export interface Palette {
  /** Behind the scene. */
  ground: string;
  /** Behind plots. */
  surface: string;
  ink: string;
  muted: string;
  /** Grids and axes. */
  line: string;
  segments: Record<SegmentKind, string>;
  statuses: Record<Status, string>;
  /** Of six joints. */
  joints: readonly string[];
  planned: string;
  executed: string;
  /** A limit, and what is beyond it. */
  limit: string;
}

const LIGHT: Palette = {
  ground: "#eef1f4",
  surface: "#ffffff",
  ink: "#16202a",
  muted: "#56636f",
  line: "#dde3e8",
  segments: {
    wash: "#cc00a0",
    transit: "#0072b2",
    approach: "#e69f00",
    retreat: "#e69f00",
    depart: "#7c8b98",
    return: "#7c8b98",
  },
  statuses: { proved: "#00775a", violated: "#b5460b", not_proved: "#8a6100", waived: "#52606d" },
  joints: ["#0072b2", "#b57b00", "#00805e", "#c4500a", "#3aa0d8", "#a9427f"],
  planned: "#0072b2",
  executed: "#c4500a",
  limit: "#b5460b",
};

const DARK: Palette = {
  ground: "#10151a",
  surface: "#171d23",
  ink: "#e8edf1",
  muted: "#98a5b0",
  line: "#2a333b",
  segments: {
    wash: "#ff5fd0",
    transit: "#56b4e9",
    approach: "#e6a93c",
    retreat: "#e6a93c",
    depart: "#7c8b98",
    return: "#7c8b98",
  },
  statuses: { proved: "#35c79b", violated: "#ff8a52", not_proved: "#f0bf4c", waived: "#a9b6c1" },
  joints: ["#4ea6e6", "#e6a93c", "#35c79b", "#ff8a52", "#9bd7ff", "#e79acb"],
  planned: "#56b4e9",
  executed: "#ff8a52",
  limit: "#ff8a52",
};

export function palette(theme: Theme): Palette {
  return theme === "dark" ? DARK : LIGHT;
}

/** Keys of a live cell, wherever the focus is, and those of the plate that is selected, on its row and on the scene. */
import type { Commands } from "./commands.ts";
import type { ToolbarActions } from "./toolbar.ts";

export interface EditKeys extends ToolbarActions {
  /** A key on the scene; whether it was of use. */
  plate(event: KeyboardEvent): boolean;
}

/** Whether the focus is where something is being typed, which undoes that itself. */
function isTyping(event: KeyboardEvent): boolean {
  const target = event.target;
  return target instanceof HTMLElement && target.matches("input, textarea") && target.dataset["dirty"] === "true";
}

export function listenToEditKeys(canvas: HTMLCanvasElement, keys: EditKeys): void {
  canvas.tabIndex = 0;
  canvas.setAttribute("role", "application");
  canvas.setAttribute("aria-description", "A plate that is selected is moved with the arrow keys and turned about the arm with R; the list of plates does the same.");
  canvas.addEventListener("keydown", (event) => {
    if (keys.plate(event)) event.preventDefault();
  });
  document.addEventListener("keydown", (event) => {
    if (event.defaultPrevented || event.altKey || !(event.ctrlKey || event.metaKey)) return;
    const key = event.key.toLowerCase();
    if (key === "s") keys.save();
    else if (key === "z" && !isTyping(event)) (event.shiftKey ? keys.redo : keys.undo)();
    else if (key === "y" && !isTyping(event)) keys.redo();
    else return;
    event.preventDefault();
  });
}

const STEP_M = 0.005;
const COARSE_M = 0.05;
const FINE_M = 0.001;
const TURN_RAD = Math.PI / 180;

const ARROWS: Readonly<Record<string, readonly [number, number]>> = {
  ArrowLeft: [-1, 0],
  ArrowRight: [1, 0],
  ArrowUp: [0, 1],
  ArrowDown: [0, -1],
};

/** For the help. */
export const PLATE_KEYS: [string, string][] = [
  ["N", "in the scene: select the next plate; with Shift the one before"],
  ["↑ ↓ ← →", "on a plate: move it 5 mm along x or y, whichever the arrow points along on the screen; with Shift 50 mm, with Alt 1 mm"],
  ["R", "on a plate: turn it 1° about the arm’s axis, counter-clockwise; with Shift clockwise"],
  ["Enter", "on a plate: take the nearest place that can be washed"],
  ["Delete", "on a plate: remove it"],
  ["Escape", "give up what is being dragged; then select nothing"],
  ["Ctrl+Z Ctrl+Y", "undo, redo"],
  ["Ctrl+S", "save"],
];

/** Does what a key says of plates; whether it says anything. Where none is selected, keys are the film's. */
export function plateKey(event: KeyboardEvent, commands: Commands, cancel: () => void): boolean {
  if (event.ctrlKey || event.metaKey) return false;
  if (event.key.toLowerCase() === "n" && !event.altKey) {
    commands.next(event.shiftKey ? -1 : 1);
    return true;
  }
  if (!commands.active) return false;
  const arrow = ARROWS[event.key];
  if (arrow !== undefined) {
    const step = event.altKey ? FINE_M : event.shiftKey ? COARSE_M : STEP_M;
    commands.shift(arrow[0] * step, arrow[1] * step);
    return true;
  }
  if (event.altKey) return false;
  const meanings: Record<string, () => void> = {
    r: () => commands.turn(event.shiftKey ? -TURN_RAD : TURN_RAD),
    delete: () => commands.remove(commands.selected),
    backspace: () => commands.remove(commands.selected),
    enter: () => commands.take(commands.selected),
    escape: cancel,
  };
  const does = meanings[event.key.toLowerCase()];
  does?.();
  return does !== undefined;
}

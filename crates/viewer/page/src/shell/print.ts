/** The page on paper: light, unfolded, with a still of the scene. */
import { el } from "./dom.ts";

/**
 * Calls `prepare` before and after printing, and keeps a copy of the scene that it has drawn: the canvas's own content is gone once it
 * was shown.
 */
export function listenToPrint(canvas: HTMLCanvasElement, prepare: (printing: boolean) => void): void {
  const still = el("canvas", { class: "print-still", set: { "aria-hidden": "true" } });
  canvas.after(still);
  addEventListener("beforeprint", () => {
    prepare(true);
    still.width = canvas.width;
    still.height = canvas.height;
    if (canvas.width > 0 && canvas.height > 0) still.getContext("2d")?.drawImage(canvas, 0, 0);
  });
  addEventListener("afterprint", () => prepare(false));
}

/** Hands on the scene: pointers that press, drag and let go of plates, ghosts and the ring. */
import type { Editing } from "./editing.ts";
import { carried, type Centre, type Grab } from "./grab.ts";

/** What a pointer is over. */
export type Picked = { kind: "plate" | "ghost"; plate: number } | { kind: "ring" } | { kind: "body"; body: number };

/** How a drag goes on. */
export type Phase = "start" | "drag" | "end" | "cancel";

/** What is done with what hands do. Places on the canvas are CSS pixels from its upper left corner. */
type Touched = Pick<Editing, "pick" | "hover" | "grab" | "toPlane" | "begin" | "carry" | "press" | "click" | "setCamera">;

/** Way of a pointer up to which it has not moved [CSS px]. */
const STILL_PX = 4;

interface Held {
  pointer: number;
  picked: Picked | null;
  grab: Grab | null;
  height_m: number;
  at: [number, number];
  moved: boolean;
  centres_m: Centre[];
}

export class Handles {
  readonly #canvas: HTMLCanvasElement;
  readonly #touched: Touched;
  #held: Held | null = null;

  constructor(canvas: HTMLCanvasElement, touched: Touched) {
    this.#canvas = canvas;
    this.#touched = touched;
    // Before the camera's own, which is asked not to turn.
    canvas.addEventListener("pointerdown", this.#down, { capture: true });
    canvas.addEventListener("pointermove", this.#move, { capture: true });
    canvas.addEventListener("pointerup", this.#up, { capture: true });
    canvas.addEventListener("pointercancel", this.#lost, { capture: true });
    canvas.addEventListener("lostpointercapture", this.#lost, { capture: true });
    canvas.addEventListener("pointerleave", this.#leave);
    window.addEventListener("keydown", this.#key, { capture: true });
  }

  /** Whether plates are being dragged. */
  get dragging(): boolean {
    return this.#held?.grab !== null && this.#held?.moved === true;
  }

  #place(event: PointerEvent): [number, number] {
    const { left, top } = this.#canvas.getBoundingClientRect();
    return [event.clientX - left, event.clientY - top];
  }

  readonly #down = (event: PointerEvent): void => {
    if (this.#held !== null || !event.isPrimary || event.button !== 0) return;
    const at = this.#place(event);
    const picked = this.#touched.pick(...at, event.pointerType !== "mouse");
    const hold = picked === null ? null : this.#touched.grab(picked, ...at);
    this.#held = { pointer: event.pointerId, picked, grab: hold?.grab ?? null, height_m: hold?.height_m ?? 0, at, moved: false, centres_m: [] };
    // A body that is not selected lets the camera turn: it may be all that is in sight.
    if (picked === null || (picked.kind === "body" && hold === null)) return;
    this.#touched.setCamera(false);
    this.#canvas.setPointerCapture(event.pointerId);
    if (hold !== null) this.#canvas.style.cursor = "grabbing";
    this.#touched.press(picked);
  };

  readonly #move = (event: PointerEvent): void => {
    const held = this.#held;
    if (held === null) {
      if (event.isPrimary && event.buttons === 0) this.#hover(event);
      return;
    }
    if (event.pointerId !== held.pointer) return;
    const at = this.#place(event);
    if (!held.moved && Math.hypot(at[0] - held.at[0], at[1] - held.at[1]) < STILL_PX) return;
    if (!held.moved) this.#begin(held);
    this.#drag(held, at, event.altKey);
  };

  #begin(held: Held): void {
    held.moved = true;
    if (held.grab !== null && !this.#touched.begin(held.grab)) held.grab = null;
    if (held.grab === null) return;
    held.centres_m = held.grab.starts_m;
    this.#touched.carry(held.grab, held.centres_m, "start");
  }

  #drag(held: Held, at: [number, number], fine: boolean): void {
    if (held.grab === null) return;
    const place = this.#touched.toPlane(...at, held.height_m);
    const centres = place === null ? null : carried(held.grab, place, fine);
    if (centres === null || String(centres) === String(held.centres_m)) return;
    held.centres_m = centres;
    this.#touched.carry(held.grab, centres, "drag");
  }

  readonly #up = (event: PointerEvent): void => {
    const held = this.#held;
    if (held === null || event.pointerId !== held.pointer) return;
    if (held.moved) this.#drag(held, this.#place(event), event.altKey);
    this.#release();
    if (!held.moved) this.#touched.click(held.picked);
    else if (held.grab !== null) this.#touched.carry(held.grab, held.centres_m, "end");
    if (event.pointerType === "mouse") this.#hover(event);
  };

  readonly #lost = (event: PointerEvent): void => {
    if (event.pointerId === this.#held?.pointer) this.cancel();
  };

  readonly #leave = (): void => {
    if (this.#held === null) this.#touched.hover(null);
  };

  readonly #key = (event: KeyboardEvent): void => {
    if (event.key !== "Escape" || !this.dragging) return;
    event.preventDefault();
    event.stopImmediatePropagation();
    this.cancel();
  };

  /** Puts back what is dragged. */
  cancel(): void {
    const held = this.#held;
    if (held === null) return;
    this.#release();
    if (held.moved && held.grab !== null) this.#touched.carry(held.grab, held.grab.starts_m, "cancel");
  }

  #release(): void {
    const held = this.#held;
    this.#held = null;
    if (held === null || held.picked === null) return;
    if (this.#canvas.hasPointerCapture(held.pointer)) this.#canvas.releasePointerCapture(held.pointer);
    this.#canvas.style.cursor = "";
    this.#touched.setCamera(true);
  }

  #hover(event: PointerEvent): void {
    const picked = this.#touched.pick(...this.#place(event), event.pointerType !== "mouse");
    this.#touched.hover(picked);
    this.#canvas.style.cursor = picked === null ? "" : picked.kind === "ghost" || picked.kind === "body" ? "pointer" : "grab";
  }
}

/** Keys of a live cell, wherever the focus is, and those of the plate that is selected on the scene. */

export interface EditKeys {
  undo(): void;
  redo(): void;
  save(): void;
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

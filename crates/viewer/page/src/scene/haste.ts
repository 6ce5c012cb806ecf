/** Drawing without a graphics processor: whether the browser does, and which frames are then drawn in haste. */

/** Names of renderers that compute every pixel on the processor. */
const NAMES = /swiftshader|llvmpipe|softpipe|lavapipe|software|basic render/i;

/** What a context is drawn by; some browsers name it only where asked through an extension. */
function nameOf(context: WebGL2RenderingContext): string {
  const plain = String(context.getParameter(context.RENDERER));
  if (plain !== "WebKit WebGL") return plain;
  const asked = context.getExtension("WEBGL_debug_renderer_info");
  return asked === null ? plain : String(context.getParameter(asked.UNMASKED_RENDERER_WEBGL));
}

/** Asks a canvas of its own: one that has a context gets no other. False where there is no WebGL 2 at all. */
export function drawsInSoftware(): boolean {
  const ask = (attributes: WebGLContextAttributes): WebGL2RenderingContext | null => {
    const canvas = document.createElement("canvas");
    canvas.width = canvas.height = 1;
    return canvas.getContext("webgl2", { antialias: false, ...attributes });
  };
  const fast = ask({ failIfMajorPerformanceCaveat: true });
  const context = fast ?? ask({});
  if (context === null) return false;
  const software = fast === null || NAMES.test(nameOf(context));
  context.getExtension("WEBGL_lose_context")?.loseContext();
  return software;
}

/** Changes that come sooner than this one after the other are fast, and after so long without any things rest [ms]. */
const REST_MS = 250;
/** As long as a hand holds something, it is likely to go on [ms]. */
const HELD_MS = 600;

/**
 * While things change fast a coarse picture that comes at once is worth more than a fine one that comes late. Once they rest, the fine
 * one is owed.
 */
export class Haste {
  readonly #able: boolean;
  #changed = false;
  #hurried = false;
  #owed = false;
  /** When a change was last drawn [ms], and whether that was with the frame before. */
  #last_ms = -Infinity;
  #ago = Infinity;

  /** Without `able` no frame is hasty. */
  constructor(able: boolean) {
    this.#able = able;
  }

  /** Something changed, as it may with every frame. */
  change(): void {
    this.#changed = true;
  }

  /** Something changed that somebody waits for, or that changes on and on. */
  hurry(): void {
    this.#changed = this.#hurried = true;
  }

  /** Whether things have come to rest after a hasty frame. Asked once a frame. */
  owes(now_ms: number, held: boolean): boolean {
    this.#ago++;
    return this.#owed && !this.#changed && now_ms - this.#last_ms >= (held ? HELD_MS : REST_MS);
  }

  /** Whether the frame that comes now is to be a hasty one. A slow frame delays the next: what follows without a pause is fast, too. */
  hasty(now_ms: number): boolean {
    if (!this.#able || !this.#changed) return false;
    return this.#hurried || this.#ago <= 1 || now_ms - this.#last_ms < REST_MS;
  }

  /** A frame was drawn. */
  drawn(now_ms: number, hasty: boolean): void {
    if (this.#changed) [this.#last_ms, this.#ago] = [now_ms, 0];
    this.#changed = this.#hurried = false;
    this.#owed = hasty;
  }
}

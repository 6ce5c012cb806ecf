/** Whether the browser draws without a graphics processor. */

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

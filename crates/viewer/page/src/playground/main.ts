/** The playground: a live cell whose engine runs in this browser. */
import "../language.ts"; // Before uPlot, which `app.ts` loads.
import { App } from "../app.ts";
import { askOnce, type Channel, ChannelError } from "../edit/channel.ts";
import { byId, el } from "../shell/dom.ts";
import { checkedEdit, checkedView, DocumentError } from "../view.ts";
import { EngineError, loadEngine, loadWorker, WorkerChannel } from "./engine.ts";
import { BrowserPlayground } from "./playground.ts";
import type { ShippedScenario } from "./tools.ts";

/** Put in by the build: size of `engine.bin`. */
declare const ENGINE_BYTES: number;

/** The only line of an answer. */
async function first(channel: Channel, path: string, question: object): Promise<unknown> {
  const line = await askOnce(channel, path, question, new AbortController().signal);
  const { kind, words } = (line ?? {}) as { kind?: string; words?: string };
  if (line === null || kind === "failed") throw new EngineError(words ?? "The engine gives no answer. Load the page again.");
  return line;
}

async function start(onShare: (share: number) => void): Promise<App> {
  const [module, program] = await Promise.all([loadEngine(ENGINE_BYTES, onShare), loadWorker()]);
  const channel = new WorkerChannel(module, program);
  const shipped = (await first(channel, "/shipped", {})) as ShippedScenario[];
  const playground = new BrowserPlayground(channel, shipped);
  const text = await playground.linkedText();
  const { view, edit } = (await first(channel, "/open", { text })) as { view: unknown; edit: unknown };
  return new App(checkedView(view), checkedEdit(edit), playground);
}

async function main(): Promise<void> {
  const bar = el("progress", { set: { max: 1, value: 0, "aria-label": "Loading" } });
  const loading = el("div", { class: "message loading", set: { role: "status" } }, el("p", {}, "Loading the planner and the prover …"), bar);
  document.body.prepend(loading);
  try {
    const app = await start((share) => {
      bar.value = share;
    });
    loading.remove();
    window.platewash = app.handle;
    app.start();
    // Where there is none, as in private windows of some browsers, the page needs its server each time.
    void navigator.serviceWorker?.register("service-worker.js").catch(() => undefined);
  } catch (error) {
    const known = error instanceof EngineError || error instanceof DocumentError || error instanceof ChannelError;
    loading.remove();
    const words = known ? error.message : "This page does not work in this browser.";
    byId("main").replaceChildren(el("p", { class: "message", set: { role: "alert" } }, words));
    if (!known) throw error;
  }
}

void main();

/** The playground: a live cell whose engine runs in this browser. */
import "../language.ts"; // Before uPlot, which `app.ts` loads.
import { App } from "../app.ts";
import type { Channel } from "../edit/channel.ts";
import { byId, el } from "../shell/dom.ts";
import { checkedEdit, checkedView, DocumentError } from "../view.ts";
import { EngineError, loadEngine, WorkerChannel } from "./engine.ts";
import { OpenPlayground } from "./playground.ts";
import type { ShippedScenario } from "./tools.ts";

/** Put in by the build: size of `engine.bin`. */
declare const ENGINE_BYTES: number;

/** The first line of an answer. */
async function first(channel: Channel, path: string, question: object): Promise<unknown> {
  let line: unknown = null;
  await channel.ask(path, question, (told) => {
    line ??= told;
  }, new AbortController().signal);
  const { kind, words } = line as { kind?: string; words?: string };
  if (kind === "failed") throw new EngineError(words ?? "");
  return line;
}

async function start(onShare: (share: number) => void): Promise<App> {
  const channel = new WorkerChannel(await loadEngine(ENGINE_BYTES, onShare));
  const shipped = (await first(channel, "/shipped", {})) as ShippedScenario[];
  const playground = new OpenPlayground(channel, shipped);
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
    const known = error instanceof EngineError || error instanceof DocumentError;
    loading.remove();
    const words = known ? error.message : "This page does not work in this browser.";
    byId("main").replaceChildren(el("p", { class: "message", set: { role: "alert" } }, words));
    if (!known) throw error;
  }
}

void main();

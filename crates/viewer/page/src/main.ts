import "./language.ts"; // Before uPlot, which `app.ts` loads.
import { App } from "./app.ts";
import { NumbersError } from "./numbers.ts";
import { byId, el } from "./shell/dom.ts";
import { DocumentError, readEdit, readView } from "./view.ts";

function main(): void {
  try {
    const app = new App(readView(document), readEdit(document));
    window.platewash = app.handle;
    app.start();
  } catch (error) {
    const known = error instanceof DocumentError || error instanceof NumbersError;
    const words = known ? error.message : "This page does not work in this browser.";
    byId("main").replaceChildren(el("p", { class: "message", set: { role: "alert" } }, words));
    if (!known) throw error;
  }
}

main();

/**
 * Takes pictures of a page in the browser of the tests. `make.py` calls it from the folder of the browser's packages:
 *
 *     node page.mjs PAGE.html FOLDER FRAMES
 *     node page.mjs PAGE.html FOLDER film
 *
 * The first takes `page.jpg`, all of it in the middle of the first wash, and so many frames of its scene, evenly over the motion, by the
 * page's own button "Picture". The second plays "See the proof" under a clock of its own: scene, ticks and time, without the page's other
 * controls, and the card in the end. `film.json` says how long each frame is shown [ms].
 */
import { writeFileSync } from "node:fs";
import { join } from "node:path";
import { pathToFileURL } from "node:url";
import { launch } from "./lib/browser.mjs";

const [FILM, FRAME_MS, CARD_MS] = [{ width: 960, height: 600 }, 1000 / 12, 5000];
/** A frame is drawn in full once the page has been at rest for a quarter of a second. */
const REST_MS = 400;
const ONLY_THE_FILM = `
  body { grid-template: minmax(0, 1fr) / minmax(0, 1fr) !important; }
  #main { grid-template: "stage" minmax(0, 1fr) "transport" auto / minmax(0, 1fr) !important; }
  #header, #panels, .toolbar, .readout, #transport > :not(.scrubber), .tour p, .tour .button { display: none !important; }
  .tour { width: max-content !important; }
  .proof-card { overflow: hidden; outline: none !important; }
  .proof-card > :not(canvas) { display: none !important; }`;

const [html, folder, wanted] = process.argv.slice(2);
const browser = await launch();
const page = await browser.newPage({ viewport: wanted === "film" ? FILM : { width: 1280, height: 800 } });
await page.goto(pathToFileURL(html).href);
await page.waitForFunction(() => window.platewash?.view !== undefined);
await page.evaluate(() => window.platewash.ready);
const name = (k) => join(folder, `frame-${String(k).padStart(3, "0")}.png`);
await (wanted === "film" ? film() : pictures(Number(wanted)));
await browser.close();

async function pictures(frames) {
  const duration = await page.evaluate(() => window.platewash.duration);
  const seek = (t_s) => page.evaluate((t_s) => (window.platewash.pause(), window.platewash.seek(t_s)), t_s);

  await seek(0.1 * duration);
  // At rest, it is drawn in full.
  await page.waitForTimeout(6000);
  await page.screenshot({ path: join(folder, "page.jpg"), type: "jpeg", quality: 80 });

  for (let k = 0; k < frames; k++) {
    await seek((duration * k) / frames);
    const [download] = await Promise.all([page.waitForEvent("download"), page.keyboard.press("p")]);
    await download.saveAs(name(k));
  }
}

async function film() {
  await page.addStyleTag({ content: ONLY_THE_FILM });
  await page.evaluate(() => {
    const film = window.platewash;
    let now_ms = 0;
    film.pause();
    film.setClock(() => now_ms);
    film.step();
    [...document.querySelectorAll("button")].find((button) => button.textContent === "See the proof").click();
    // What is shown, to tell whether a frame is another one than that before.
    window.pass = (ms) => {
      now_ms += ms;
      film.step();
      const ended = document.querySelector("dialog[open]") !== null;
      return { ended, shown: [film.time(), ...[...document.querySelectorAll(".tour, .tour-label")].map((part) => part.textContent)].join() };
    };
  });
  const shown_ms = [];
  for (let last = null, ended = false; !ended; ) {
    const found = await page.evaluate((ms) => window.pass(ms), FRAME_MS);
    ended = found.ended;
    if (found.shown === last && !ended) {
      shown_ms[shown_ms.length - 1] += FRAME_MS;
      continue;
    }
    last = found.shown;
    await page.waitForTimeout(REST_MS);
    await page.evaluate(() => window.pass(0));
    await page.screenshot({ path: name(shown_ms.length) });
    shown_ms.push(ended ? CARD_MS : FRAME_MS);
  }
  writeFileSync(join(folder, "film.json"), JSON.stringify(shown_ms));
}

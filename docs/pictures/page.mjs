/**
 * Takes pictures of a page in the browser of the tests: `page.jpg`, all of it in the middle of the first wash, and so many frames of its
 * scene, evenly over the motion, by the page's own button "Picture". `make.py` calls it from the folder of the browser's packages:
 *
 *     node page.mjs PAGE.html FOLDER FRAMES
 */
import { join } from "node:path";
import { pathToFileURL } from "node:url";
import { launch } from "./lib/browser.mjs";

const [html, folder, frames] = process.argv.slice(2);
const browser = await launch();
const page = await browser.newPage({ viewport: { width: 1280, height: 800 } });
await page.goto(pathToFileURL(html).href);
await page.waitForFunction(() => window.platewash?.view !== undefined);
await page.evaluate(() => window.platewash.ready);
const duration = await page.evaluate(() => window.platewash.duration);
const seek = (t_s) => page.evaluate((t_s) => (window.platewash.pause(), window.platewash.seek(t_s)), t_s);

await seek(0.1 * duration);
// At rest, it is drawn in full.
await page.waitForTimeout(6000);
await page.screenshot({ path: join(folder, "page.jpg"), type: "jpeg", quality: 80 });

for (let k = 0; k < Number(frames); k++) {
  await seek((duration * k) / Number(frames));
  const [download] = await Promise.all([page.waitForEvent("download"), page.keyboard.press("p")]);
  await download.saveAs(join(folder, `frame-${String(k).padStart(3, "0")}.png`));
}
await browser.close();

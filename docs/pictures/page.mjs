/**
 * Makes the README's picture of the page, `page.jpg`:
 *
 *     cargo xtask test --only browser                        # fetches the browser into target/browser
 *     cp docs/pictures/page.mjs target/browser/
 *     target/node/bin/node target/browser/page.mjs out/page.html docs/pictures/page.jpg
 */
import { launch } from "./lib/browser.mjs";
import { pathToFileURL } from "node:url";

const [html, picture] = process.argv.slice(2);
const browser = await launch();
const page = await browser.newPage({ viewport: { width: 1280, height: 800 } });
await page.goto(pathToFileURL(html).href);
await page.waitForFunction(() => window.platewash?.view !== undefined);
// In the middle of the first wash; at rest, it is drawn in full.
await page.waitForTimeout(4000);
await page.keyboard.press("Space");
await page.waitForTimeout(6000);
await page.screenshot({ path: picture, type: "jpeg", quality: 80 });
await browser.close();

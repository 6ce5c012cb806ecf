/**
 * Pictures of the page for people to look at: every shipped scenario at three sizes, light and dark, and a live cell with a change that is
 * refused. `cargo xtask screenshots` sets the words and the environment: node screenshots.mjs FOLDER [SCENARIO …].
 */
import { mkdirSync, readdirSync } from "node:fs";
import { readFile, writeFile } from "node:fs/promises";
import { basename, join } from "node:path";
import { launch, unpack } from "./lib/browser.mjs";
import { change, settled } from "./lib/cell.mjs";
import { folder, kitchen, page, serve } from "./lib/command.mjs";
import { open } from "./lib/watched.mjs";

const SIZES = [{ width: 1280, height: 800 }, { width: 390, height: 844 }, { width: 1920, height: 1080 }];
const THEMES = ["light", "dark"];
/** Exit codes of a run: washed, infeasible, not verified. */
const CODES = [0, 3, 4];
/** A post beside the plates, and where the arm stands. */
const POST = '[[obstacle]]\nname = "post"\nshape = "box"\nsize_m = [0.06, 0.06, 0.3]\nat_m = [-0.35, 0.25, 0.15]\n';
const REFUSED = [{ key: "obstacle[0].at_m", value: [0.1, 0.0, 0.4] }];

const [out, ...chosen] = process.argv.slice(2);
const ends = [];
const life = { after: (end) => ends.push(end) };

/** Saves what is in the window. */
async function shoot(opened, name) {
  await opened.waitForTimeout(700);
  await opened.screenshot({ path: join(out, `${name}.png`), type: "png" });
  process.stdout.write(`    ${name}\n`);
}

const variants = () => SIZES.flatMap((size) => THEMES.map((colorScheme) => ({ size, colorScheme, tag: `${size.width}-${colorScheme}` })));

async function scenario(name) {
  const file = await page(await folder(life), name, CODES);
  for (const { size, colorScheme, tag } of variants()) {
    const { page: opened } = await open(life, `file://${file}`, { size, colorScheme });
    await shoot(opened, `${name}-${tag}`);
    await opened.context().close();
  }
}

/** A live cell: proved, and after a change that is refused. */
async function cell() {
  const place = await folder(life);
  const file = await kitchen(place, ["\n[wash]", `\n${POST}\n[wash]`]);
  const server = await serve(life, place, ["edit", "--no-open", "--scenario", file]);
  for (const { size, colorScheme, tag } of variants()) {
    const { page: opened } = await open(life, server.url, { size, colorScheme });
    await settled(opened);
    await shoot(opened, `edit-${tag}`);
    await change(opened, REFUSED);
    await shoot(opened, `edit-refused-${tag}`);
    await opened.context().close();
  }
}

/** All pictures of a size and a theme on one sheet. */
async function sheets(browser) {
  for (const { size, tag } of variants()) {
    const files = readdirSync(out).filter((file) => file.endsWith(`-${tag}.png`) && !file.startsWith("sheet-")).sort();
    const width = size.width === 390 ? 260 : 640;
    const figures = await Promise.all(files.map(async (file) => {
      const data = (await readFile(join(out, file))).toString("base64");
      return `<figure><img width="${width}" src="data:image/png;base64,${data}"><figcaption>${basename(file, `-${tag}.png`)}</figcaption></figure>`;
    }));
    const sheet = await browser.newPage({ viewport: { width: 2000, height: 800 } });
    const style = "body{margin:0;display:flex;flex-wrap:wrap;gap:8px;font:14px sans-serif}figure{margin:0}";
    await sheet.setContent(`<style>${style}</style>${figures.join("")}`, { waitUntil: "load" });
    await sheet.screenshot({ path: join(out, `sheet-${tag}.png`), type: "png", fullPage: true });
    await sheet.close();
  }
}

await unpack();
mkdirSync(out, { recursive: true });
const shipped = readdirSync(join(process.env["PLATEWASH_ROOT"], "scenarios")).map((file) => basename(file, ".toml")).sort();
try {
  for (const name of chosen.length > 0 ? chosen : [...shipped, "edit"]) await (name === "edit" ? cell() : scenario(name));
  const browser = await launch();
  await sheets(browser);
  await browser.close();
} finally {
  for (const end of ends.reverse()) await end();
}

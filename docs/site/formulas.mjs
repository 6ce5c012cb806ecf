/** Sets the formulas of a built website: writes them as HTML in place of their TeX. A formula that cannot be set is an error. */
import katex from "katex";
import { cpSync, readFileSync, readdirSync, writeFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";

const SITE = "site";
const FORMULA = /<(div|span) class="arithmatex">\\([[(])(.*?)\\[\])]<\/\1>/gs;
const ENTITIES = { "&amp;": "&", "&lt;": "<", "&gt;": ">" };

let formulas = 0;
for (const name of readdirSync(SITE, { recursive: true }).filter((name) => name.endsWith(".html"))) {
  const file = join(SITE, name);
  const page = readFileSync(file, "utf8");
  const set = page.replace(FORMULA, (_, element, opening, text) => {
    const tex = text.replace(/&(amp|lt|gt);/g, (entity) => ENTITIES[entity]);
    formulas += 1;
    return `<${element}>${katex.renderToString(tex, { displayMode: opening === "[", strict: "error" })}</${element}>`;
  });
  if (set.includes("arithmatex")) throw new Error(`${file}: a formula that was not set`);
  if (set === page) continue;
  const styles = `${"../".repeat(name.split(/[\\/]/).length - 1)}assets/katex/katex.min.css`;
  // First of all styles, so that those of the website win.
  writeFileSync(file, set.replace("<head>", `<head><link rel="stylesheet" href="${styles}">`));
}
if (formulas === 0) throw new Error("no page has a formula");
const dist = dirname(fileURLToPath(import.meta.resolve("katex")));
cpSync(join(dist, "katex.min.css"), join(SITE, "assets/katex/katex.min.css"));
cpSync(join(dist, "fonts"), join(SITE, "assets/katex/fonts"), { recursive: true });
console.log(`${formulas} formulas`);

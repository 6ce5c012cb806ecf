/** Links each picture of a built website to its file, so that a click shows it in full size. A picture that is in a link already is left. */
import { readFileSync, readdirSync, writeFileSync } from "node:fs";
import { join } from "node:path";

const SITE = "site";
/** Those of others are no pages of the documentation. */
const OTHERS = /^(rust|playground)\b/;
const PICTURE = /(<a [^>]*>\s*)?<img [^>]*>/g;
const attribute = (tag, name) => new RegExp(` ${name}="([^"]*)"`).exec(tag)?.[1];

let pictures = 0;
for (const name of readdirSync(SITE, { recursive: true }).filter((name) => name.endsWith(".html") && !OTHERS.test(name))) {
  const file = join(SITE, name);
  const page = readFileSync(file, "utf8");
  const linked = page.replace(PICTURE, (tag, link) => {
    if (link !== undefined) return tag;
    const [from, words] = [attribute(tag, "src"), attribute(tag, "alt")];
    if (!from || !words) throw new Error(`${file}: a picture without a file or words: ${tag}`);
    pictures += 1;
    return `<a class="picture" href="${from}" title="${words}">${tag}</a>`;
  });
  if (linked !== page) writeFileSync(file, linked);
}
if (pictures === 0) throw new Error("no page has a picture");
console.log(`${pictures} pictures`);

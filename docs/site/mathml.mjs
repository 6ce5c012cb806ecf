/** Writes the numbered formulas of pages as MathML, by their numbers, for the page in 3-D: node mathml.mjs OUT.json PAGE.md … */
import katex from "katex";
import { readFileSync, writeFileSync } from "node:fs";

const BLOCK = /```math\n(.*?)\n```/gs;
const NUMBER = /\s*\\tag\{([\d.]+)\}/;

const [out, ...pages] = process.argv.slice(2);
const formulas = {};
for (const page of pages) {
  for (const [, tex] of readFileSync(page, "utf8").matchAll(BLOCK)) {
    const number = NUMBER.exec(tex)?.[1];
    if (number === undefined) continue;
    if (number in formulas) throw new Error(`${page}: formula (${number}) stands there twice`);
    const set = katex.renderToString(tex.replace(NUMBER, ""), { displayMode: true, output: "mathml", strict: "error" });
    const math = /<math.*<\/math>/s.exec(set)[0].replace(/<annotation.*?<\/annotation>/s, "").replace(/<\/?semantics>/g, "");
    // Letters that slant by style: many machines have no font with slanted letters of their own.
    const plain = math.replace(/<mi>(.)<\/mi>/gu, '<mi class="letter" mathvariant="normal">$1</mi>');
    // Signs that fonts for text have, too.
    const common = plain.replaceAll("∥", "||").replaceAll("∣", "|").replaceAll("⋅", "·");
    formulas[number] = common.replace('xmlns="http://www.w3.org/1998/Math/MathML" ', "");
  }
}
if (Object.keys(formulas).length === 0) throw new Error(`no formula with a number in ${pages.join(", ")}`);
writeFileSync(out, `${JSON.stringify(formulas, null, 1)}\n`);
console.log(`${Object.keys(formulas).length} formulas as MathML`);

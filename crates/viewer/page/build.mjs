/**
 * Makes the page's bundle: `node build.mjs --out DIR` writes index.html, page.js, page.css and notices.txt into DIR. The same
 * sources and packages give the same bytes.
 */
import { existsSync, mkdirSync, readdirSync, readFileSync, writeFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { parseArgs } from "node:util";

const HERE = dirname(fileURLToPath(import.meta.url));
const PLACEHOLDERS = ["title", "style", "data", "script", "notices"];

/** esbuild's settings for both files. */
const COMMON = {
  absWorkingDir: HERE,
  bundle: true,
  minify: true,
  write: false,
  metafile: true,
  charset: "utf8",
  legalComments: "none",
  logLevel: "warning",
};

async function bundle(settings) {
  const { build } = await import("esbuild");
  const { outputFiles, metafile } = await build({ ...COMMON, ...settings });
  if (outputFiles.length !== 1) throw new Error(`${settings.entryPoints}: ${outputFiles.length} files instead of one`);
  return { text: outputFiles[0].text, inputs: Object.keys(metafile.inputs) };
}

const script = () =>
  bundle({
    entryPoints: ["src/main.ts"],
    outfile: "page.js",
    format: "iife",
    target: ["es2022"],
    define: { "process.env.NODE_ENV": '"production"' },
  });

const style = () => bundle({ entryPoints: ["style.css"], outfile: "page.css", target: ["chrome111", "firefox113", "safari16.4"] });

/** The packages that a bundle's inputs come from: names in order. */
function packagesOf(inputs) {
  const names = inputs.map((file) => /^node_modules\/((?:@[^/]+\/)?[^/]+)\//.exec(file.replaceAll("\\", "/"))?.[1]);
  return [...new Set(names.filter((name) => name !== undefined))].sort();
}

/** A package's own licence, word for word. */
function notice(name) {
  const folder = join(HERE, "node_modules", name);
  const { version, license } = JSON.parse(readFileSync(join(folder, "package.json"), "utf8"));
  const file = readdirSync(folder).sort().find((entry) => /^licen[cs]e(\.(md|txt))?$/i.test(entry));
  if (file === undefined) throw new Error(`${name}: no licence file in its package`);
  const text = readFileSync(join(folder, file), "utf8").replaceAll("\r\n", "\n").trim();
  return `${name} ${version} (${license})\n\n${text}\n`;
}

function notices(inputs) {
  const head = "This page contains work of others, under these licences:\n";
  return [head, ...packagesOf(inputs).map(notice)].join(`\n${"-".repeat(80)}\n\n`);
}

/** The template: every placeholder stands there once. */
function template() {
  const html = readFileSync(join(HERE, "index.html"), "utf8").replaceAll("\r\n", "\n");
  for (const name of PLACEHOLDERS) {
    const count = html.split(`<!--platewash:${name}-->`).length - 1;
    if (count !== 1) throw new Error(`index.html: placeholder ${name} stands there ${count} times instead of once`);
  }
  return html;
}

async function main() {
  const { values } = parseArgs({ options: { out: { type: "string" } } });
  if (values.out === undefined) throw new Error("usage: node build.mjs --out DIR");
  if (!existsSync(join(HERE, "node_modules"))) throw new Error("no packages: run “npm ci --ignore-scripts” first");
  const [js, css] = await Promise.all([script(), style()]);
  if (/<\/script|<!--/i.test(js.text)) throw new Error("page.js: holds what would end the script element that it stands in");
  if (/<\/style/i.test(css.text)) throw new Error("page.css: holds what would end the style element that it stands in");
  mkdirSync(values.out, { recursive: true });
  const files = {
    "index.html": template(),
    "page.js": js.text,
    "page.css": css.text,
    "notices.txt": notices([...js.inputs, ...css.inputs]),
  };
  for (const [name, text] of Object.entries(files)) writeFileSync(join(values.out, name), text);
}

main().catch((error) => {
  process.stderr.write(`error: ${error.message}\n`);
  process.exitCode = 1;
});

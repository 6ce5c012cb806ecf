/**
 * Makes the page's bundle: `node build.mjs --out DIR` writes index.html, page.js, page.css and notices.txt into DIR. The same
 * sources and packages give the same bytes.
 *
 * `node build.mjs --playground MODULE --out DIR` writes the folder of the playground, with the WebAssembly module of `crates/playground`
 * and the bundle in `page/`.
 */
import { createHash } from "node:crypto";
import { existsSync, mkdirSync, readdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { parseArgs } from "node:util";
import { gzipSync } from "node:zlib";

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

const script = (source = "src/main.ts", values = {}) =>
  bundle({
    entryPoints: [source],
    outfile: "page.js",
    format: "iife",
    target: ["es2022"],
    define: { "process.env.NODE_ENV": '"production"', ...values },
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

async function pageFiles() {
  const [js, css] = await Promise.all([script(), style()]);
  if (/<\/script|<!--/i.test(js.text)) throw new Error("page.js: holds what would end the script element that it stands in");
  if (/<\/style/i.test(css.text)) throw new Error("page.css: holds what would end the style element that it stands in");
  return {
    "index.html": template(),
    "page.js": js.text,
    "page.css": css.text,
    "notices.txt": notices([...js.inputs, ...css.inputs]),
  };
}

/** A text with one place of it replaced. */
function replaced(text, from, to) {
  const parts = text.split(from);
  if (parts.length !== 2) throw new Error(`index.html: “${from}” stands there ${parts.length - 1} times instead of once`);
  return parts.join(to);
}

/** The page of the playground: the template with scripts and styles in files of their own. */
function playgroundPage(page) {
  const escaped = page["notices.txt"].replaceAll("&", "&amp;").replaceAll("<", "&lt;");
  const changes = [
    ["script-src 'unsafe-inline'; style-src 'unsafe-inline'", "script-src 'self' 'wasm-unsafe-eval'; worker-src 'self' blob:; style-src 'self' 'unsafe-inline'"],
    ["This page draws a plan with JavaScript, which is switched off in this browser. The report beside it has the same numbers as text.", "This page plans with JavaScript and WebAssembly, which are switched off in this browser."],
    ["<!--platewash:title-->", "platewash playground"],
    ["<!--platewash:style-->", '<link rel="stylesheet" href="page/page.css">'],
    ["<!--platewash:notices-->", escaped],
    ["<!--platewash:data-->", ""],
    ["<!--platewash:script-->", '<script src="playground.js"></script>'],
  ];
  return changes.reduce((text, [from, to]) => replaced(text, from, to), page["index.html"]);
}

/** The folder of the playground. */
async function playgroundFiles(module) {
  const page = await pageFiles();
  const engine = gzipSync(readFileSync(module), { level: 9 });
  const [playground, worker] = await Promise.all([
    script("src/playground/main.ts", { ENGINE_BYTES: String(engine.length) }),
    script("src/playground/worker.ts"),
  ]);
  const files = {
    "index.html": playgroundPage(page),
    "playground.js": playground.text,
    "worker.js": worker.text,
    "engine.bin": engine,
    ...Object.fromEntries(Object.entries(page).map(([name, text]) => [`page/${name}`, text])),
  };
  const hash = createHash("sha256");
  for (const [name, content] of Object.entries(files)) hash.update(name).update("\0").update(content).update("\0");
  const values = { FILES: JSON.stringify(["./", ...Object.keys(files).filter((name) => name !== "index.html")]), VERSION: JSON.stringify(hash.digest("hex").slice(0, 16)) };
  const { text } = await script("src/playground/service-worker.ts", values);
  return { ...files, "service-worker.js": text };
}

async function main() {
  const { values } = parseArgs({ options: { out: { type: "string" }, playground: { type: "string" } } });
  if (values.out === undefined) throw new Error("usage: node build.mjs [--playground MODULE] --out DIR");
  if (!existsSync(join(HERE, "node_modules"))) throw new Error("no packages: run “npm ci --ignore-scripts” first");
  const { out, playground } = values;
  const files = playground === undefined ? await pageFiles() : await playgroundFiles(playground);
  if (playground !== undefined) {
    const standing = existsSync(out) ? readdirSync(out) : [];
    if (standing.length > 0 && !standing.includes("engine.bin")) throw new Error(`${out}: has files that are not of a playground: name an empty folder`);
    rmSync(out, { recursive: true, force: true });
  }
  for (const [name, content] of Object.entries(files)) {
    mkdirSync(dirname(join(out, name)), { recursive: true });
    writeFileSync(join(out, name), content);
  }
}

main().catch((error) => {
  process.stderr.write(`error: ${error.message}\n`);
  process.exitCode = 1;
});

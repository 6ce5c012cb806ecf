/**
 * The module of the playground and the command: the same bytes of the same scenario, and clear words where there are none. The bytes of the
 * command are those of `tests/golden`, with which the tests in Rust compare them.
 */
import assert from "node:assert/strict";
import { execFile } from "node:child_process";
import { createHash } from "node:crypto";
import { mkdtempSync, readFileSync, rmSync } from "node:fs";
import { readFile } from "node:fs/promises";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, test } from "node:test";
import { started } from "./module.mjs";

const needed = (name) => {
  const value = process.env[name];
  if (value === undefined) throw new Error(`${name} is not set: cargo xtask test --only browser sets it`);
  return value;
};

const COMMAND = needed("PLATEWASH_BIN");
const ROOT = needed("PLATEWASH_ROOT");
const DIST = join(ROOT, "crates/viewer/dist");
const DIALECTS = ["rapid", "ros2", "csv"];

const { ask } = await started(needed("PLATEWASH_MODULE"));
const place = mkdtempSync(join(tmpdir(), "platewash-playground-"));
after(() => rmSync(place, { recursive: true, force: true }));

/** Runs the command, while the module works. */
const platewash = (...words) =>
  new Promise((resolve) => {
    const ended = (error, stdout, stderr) => resolve({ code: error?.code ?? 0, stdout, stderr });
    execFile(COMMAND, words, { cwd: place, maxBuffer: 1 << 28 }, ended);
  });

const runs = new Map();

/** Runs a shipped scenario, once for all tests. */
function run(name) {
  if (!runs.has(name)) runs.set(name, platewash("run", "--quiet", "--scenario", name, "--out", name));
  return runs.get(name);
}

/** The only line of an answer. */
function only(lines) {
  assert.equal(lines.length, 1, JSON.stringify(lines));
  return lines[0];
}

/** SHA-256 of what the command writes: by scenario and file name, and by scenario, dialect and file name. */
const [outputs, programs] = ["outputs", "programs"].map((name) => JSON.parse(readFileSync(join(ROOT, `tests/golden/${name}.json`), "utf8")));

const files = (text, file, bundle = null) => ask("/file", { text, file, bundle });

/** The words of an answer that is no more than a refusal. */
function refusal(lines) {
  const { kind, words } = only(lines);
  assert.equal(kind, "failed");
  return words;
}

/** Compares a line of the module with a file of the command. */
async function same(line, ...path) {
  assert.equal(line.kind, "file", line.words);
  assert.equal(line.name, path.at(-1));
  const [found, expected] = [Buffer.from(line.text), await readFile(join(place, ...path))];
  if (found.equals(expected)) return;
  const at = found.findIndex((byte, index) => byte !== expected[index]);
  const near = (bytes) => JSON.stringify(bytes.subarray(Math.max(0, at - 40), at + 40).toString());
  assert.fail(`${path.join("/")} differs at byte ${at}: the module has ${near(found)}, the command ${near(expected)}`);
}

const shipped = only(ask("/shipped", {}));
const kitchen = shipped[0].text;

/** The kitchen with a text in it replaced. */
function changed(from, to) {
  assert.ok(kitchen.includes(from), from);
  return kitchen.replace(from, to);
}

test("the shipped scenarios are those of the command", async () => {
  const { stdout } = await platewash("scenario", "--json");
  assert.deepEqual(shipped.map(({ name, about }) => ({ name, about })), JSON.parse(stdout));
});

/** Compares a line of the module with the committed hash of the command's file. */
async function committed(line, scenario, hash) {
  assert.equal(line.kind, "file", line.words);
  if (createHash("sha256").update(line.text).digest("hex") === hash) return;
  await run(scenario);
  if (line.name in outputs[scenario]) await same(line, scenario, line.name);
  assert.fail(`${line.name} of ${scenario} has other bytes than tests/golden states`);
}

for (const { name, text } of shipped) {
  test(`plan and certificate of ${name}`, async () => {
    const [plan, certificate] = ["plan.json", "certificate.json"].map((file) => files(text, file));
    if (/^program = "paper"/m.test(text)) {
      for (const lines of [plan, certificate]) assert.match(refusal(lines), /^the scenario: job\.program = "paper"/);
      return;
    }
    await committed(only(plan), name, outputs[name]["plan.json"]);
    await committed(only(certificate), name, outputs[name]["certificate.json"]);
  });
}

test("robot programs of the kitchen", async () => {
  for (const dialect of DIALECTS) {
    const [lines, expected] = [files(kitchen, dialect), programs.kitchen[dialect]];
    assert.deepEqual(lines.map((line) => line.name).sort(), Object.keys(expected).sort());
    for (const line of lines) await committed(line, "kitchen", expected[line.name]);
  }
});

test("a program for another arm is refused with the same words", async () => {
  await run("kitchen");
  const { code, stderr } = await platewash("export", "kitchen/plan.json", "--to", "urscript");
  assert.notEqual(code, 0);
  const words = refusal(files(kitchen, "urscript"));
  assert.match(words, /URScript.*"irb120"/);
  assert.ok(stderr.includes(words), stderr);
});

test("the page of the kitchen", async () => {
  const running = run("kitchen");
  const part = (file) => readFile(join(DIST, file), "utf8");
  const [template, style, script, notices] = await Promise.all(["index.html", "page.css", "page.js", "notices.txt"].map(part));
  const lines = files(kitchen, "page.html", { template, style, script, notices });
  await running;
  await same(only(lines), "kitchen", "page.html");
  assert.match(refusal(files(kitchen, "page.html")), /parts that all pages share/);
});

test("faults are told in one line", () => {
  const cell = (text) => ask("/cell", { session: "sessionofthetest", text, edits: [], want: "proof", arm: null });
  const broken = "[layout]\ncount =";
  assert.match(refusal(files(broken, "plan.json")), /^the scenario, line 2: is not valid TOML: a value is missing/);
  const refused = only(cell(broken));
  assert.deepEqual([refused.kind, refused.line], ["refused", 2]);
  assert.match(refused.words, /^is not valid TOML: a value is missing/);
  assert.match(refusal(files(changed("count = 4", "count = 0"), "plan.json")), /^the scenario, line \d+: layout\.count must be/);
  assert.match(refusal(files(kitchen, "plan.txt")), /^plan\.txt: no such file; expected plan\.json, .*rapid/);
  assert.match(refusal(ask("/nothing", {})), /there is no question \/nothing/);
  assert.match(refusal(ask("/file", "{")), /^\/file: the question cannot be read: EOF/);
  assert.match(refusal(ask("/cell", "{}")), /missing field/);
});

test("a scenario that names a file is refused", () => {
  const NO_FILES = "a page in a browser reads no files; platewash on your computer does";
  const body = (mesh) => `${kitchen}\n[[tool_body]]\nname = "hand"\nshape = "mesh"\nmesh = "${mesh}"\n`;
  const cases = [
    ["my.urdf: cannot be read", changed('model = "irb120"', 'urdf = "my.urdf"')],
    ["tool_body[0].mesh: body of the tool 'hand': mesh 'hand.stl'", body("hand.stl")],
    ["tool_body[0].mesh: body of the tool 'hand': mesh 'package://cell/hand.stl'", body("package://cell/hand.stl")],
  ];
  for (const [what, text] of cases) assert.equal(refusal(files(text, "plan.json")), `the scenario: ${what}: ${NO_FILES}`);
});

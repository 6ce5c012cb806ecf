import assert from "node:assert/strict";
import { test } from "node:test";
import { linkTo, parseLink } from "../src/address.ts";
import { clockTime, fixed, percentDown, segmentAt, segmentWords } from "../src/format.ts";
import { decode, floats, NumbersError } from "../src/numbers.ts";
import { verdict, washed } from "../src/verdict.ts";
import { type Certificate, type Check, DocumentError, type Execution, type Numbers, parseView, type PlanSegment, type Plate, type Status, type View } from "../src/view.ts";

const check = (status: Status): Check => ({ requirement: "tilt", words: "tilt", status, detail: "", worst: {}, place: "", why: { sentence: "", group: "Within limits", place: 1, section: "", formulas: [], limit: "" } });

function viewWith(statuses: Status[] | null, certificate: Partial<Certificate> = {}): View {
  const checks = (statuses ?? []).map(check);
  const passes = checks.every(({ status }) => status === "proved" || status === "waived");
  return {
    heading: { process: "wash", dry_run: null, treatment: "washed" },
    certificate: statuses === null ? null : { passes, headline: "so", hash: "proved", checks, contact: null, rests_on: [], ...certificate },
    execution: null,
  } as unknown as View;
}

test("a verdict is never better than its worst requirement", () => {
  assert.equal(verdict(viewWith(["proved", "proved"])).tone, "proved");
  assert.equal(verdict(viewWith(["proved", "violated", "not_proved"])).tone, "violated");
  assert.equal(verdict(viewWith(["proved", "not_proved"])).tone, "not_proved");
  assert.equal(verdict(viewWith(["proved", "waived"])).tone, "waived");
});

test("a missing, failed or outdated certificate never looks proved", () => {
  assert.equal(verdict(viewWith(null)).tone, "none");
  for (const hash of ["violated", "not_proved", "waived"] as const) {
    assert.equal(verdict(viewWith(["proved"], { hash })).tone, "violated");
  }
  assert.equal(verdict(viewWith(["proved"], { passes: false })).tone, "not_proved");
  assert.equal(verdict(viewWith([], { passes: false })).tone, "not_proved");
});

const IN_AIR = "DRY RUN of 221b93b62aa8: 50 mm above the plates, nothing is washed";

test("a dry run is named first and never called washed", () => {
  const inAir = (view: View): View => ({ ...view, heading: { ...view.heading, dry_run: IN_AIR } });
  const cases: [View, string, string][] = [
    [viewWith(["proved"], { headline: `${IN_AIR}; PROVED: x` }), "proved", "Dry run: proved"],
    [viewWith(["proved", "violated"]), "violated", "Dry run: violated"],
    [viewWith(["proved"], { hash: "violated" }), "violated", "Dry run: altered"],
    [viewWith(["waived"]), "waived", "Dry run: proved but for 1 waived"],
    [viewWith(null), "none", "Dry run: no certificate"],
  ];
  for (const [view, tone, word] of cases) {
    const said = verdict(inAir(view));
    assert.deepEqual([said.tone, said.word], [tone, word]);
    assert.equal(said.sentence.split(IN_AIR).length, 2, said.sentence);
    assert.ok(said.sentence.startsWith(IN_AIR), said.sentence);
    assert.doesNotMatch(verdict(view).word, /dry run/i);
  }
  const executed = { washed: true, headline: null } as unknown as Execution;
  assert.equal(washed(inAir({ ...viewWith(["proved"]), execution: executed })), null);
});

test("washing is judged only where it was simulated", () => {
  const view = viewWith(["proved"]);
  const with_ = (result: boolean | null): View => ({ ...view, execution: { washed: result, headline: null } as unknown as Execution });
  assert.equal(washed(view), null);
  assert.equal(washed(with_(null)), null);
  assert.equal(washed(with_(false))?.tone, "violated");
  assert.equal(washed(with_(true))?.tone, "proved");
});

test("a document that cannot be read says why", () => {
  for (const text of ["", "{", "[]", "null", "{}", '{"format":"platewash-view/1"}']) {
    assert.throws(() => parseView(text), DocumentError);
  }
  assert.equal(parseView('{"format":"platewash-view/2"}').format, "platewash-view/2");
});

test("links survive writing and reading, and garbage is ignored", () => {
  const place = { t: 12.5, speed: 2, show: "executed", panel: "plots", camera: "above" } as const;
  assert.deepEqual(parseLink(linkTo(place)), place);
  const nowhere = { t: null, speed: null, show: null, panel: null, camera: null };
  for (const hash of ["", "#", "#t=", "#t=NaN&speed=-1&show=x", "#t=1e400", "#panel=<b>", "#%%%&&==", `#t=${"9".repeat(600)}`]) {
    assert.deepEqual(parseLink(hash), nowhere, hash);
  }
});

test("numbers read as numbers are written", () => {
  assert.equal(fixed(-0.5, 1), "−0.5");
  assert.equal(fixed(-0.001, 1), "0.0");
  assert.equal(fixed(Number.NaN, 1), "–");
  assert.equal(percentDown(0.99999), "99.9\u202f%");
  assert.equal(percentDown(1), "100\u202f%");
  assert.equal(clockTime(12.345, 40), "12.35");
  assert.equal(clockTime(65.04, 200), "1:05.0");
});

const PLATES = [{ name: "plate 1" }] as unknown as Plate[];
const SEGMENTS: PlanSegment[] = [
  { kind: "depart", plate: 0, t_start_s: 0, t_end_s: 1 },
  { kind: "wash", plate: 0, t_start_s: 1, t_end_s: 3 },
  { kind: "transit", plate: 7, t_start_s: 4, t_end_s: 5 },
];

test("segments are found from any hint; between and behind them there are none", () => {
  for (let hint = -1; hint < 5; hint++) {
    for (const [t, expected] of [[0, 0], [1, 1], [2.9, 1], [3.5, -1], [4, 2], [5, 2], [6, -1]] as const) {
      assert.equal(segmentAt(SEGMENTS, t, hint), expected, `${t} from ${hint}`);
    }
  }
  assert.equal(segmentAt([], 1, 0), -1);
});

const shown = (dryRun: string | null): View => ({ heading: { dry_run: dryRun }, plates: PLATES }) as unknown as View;

test("segments say what the arm does, with a plate that exists or none", () => {
  assert.deepEqual(SEGMENTS.map((segment) => segmentWords(segment, shown(null))), ["Leaving home", "Washing plate 1", "On the way"]);
  assert.deepEqual(SEGMENTS.map((segment) => segmentWords(segment, shown(IN_AIR))), ["Leaving home", "In the air over plate 1", "On the way"]);
  const nowhere: PlanSegment = { kind: "wash", plate: 7, t_start_s: 0, t_end_s: 1 };
  assert.equal(segmentWords(nowhere, shown(IN_AIR)), "In the air");
});

const base64 = (bytes: number[]): string => Buffer.from(bytes).toString("base64");

test("every kind is little-endian", () => {
  const one = Buffer.alloc(8);
  one.writeDoubleLE(-0.1);
  assert.deepEqual([...decode({ shape: [1], f64: one.toString("base64") })], [-0.1]);
  const half = Buffer.alloc(4);
  half.writeFloatLE(0.5);
  assert.deepEqual([...decode({ shape: [1], f32: half.toString("base64") })], [0.5]);
  assert.deepEqual([...decode({ shape: [2], u16: base64([255, 255, 254, 0]) })], [65535, 254]);
  assert.deepEqual([...decode({ shape: [1, 3], u8: base64([7, 0, 255]) })], [7, 0, 255]);
});

test("an empty array is one", () => {
  assert.equal(decode({ shape: [0, 6], f64: "" }).length, 0);
});

test("numbers of any kind come in double precision", () => {
  const read = floats({ shape: [2], u8: base64([3, 4]) });
  assert.ok(read instanceof Float64Array);
  assert.deepEqual([...read], [3, 4]);
});

test("arrays of another shape are refused", () => {
  const bad: Numbers[] = [
    { shape: [2], f64: base64([1, 2, 3]) },
    { shape: [1], f64: "" },
    { shape: [1], u8: "%%%" },
    { shape: [1] } as unknown as Numbers,
  ];
  for (const numbers of bad) assert.throws(() => decode(numbers), NumbersError);
});

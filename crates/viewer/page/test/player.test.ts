import assert from "node:assert/strict";
import { test } from "node:test";
import { Controls } from "../src/controls.ts";
import { LIVE_COLUMNS } from "../src/recording.ts";
import { Player } from "../src/player.ts";
import type { Execution, Numbers, PlanSegment, Plate, View } from "../src/view.ts";

const f64 = (rows: number[], ...shape: number[]): Numbers => ({ shape, f64: Buffer.from(Float64Array.from(rows).buffer).toString("base64") });
const six = (value: number): number[] => new Array<number>(6).fill(value);

function execution(source: Execution["source"], times: number[]): Execution {
  return {
    source,
    law: null,
    headline: null,
    washed: null,
    t_s: f64(times, times.length),
    q_rad: f64(times.flatMap((t) => six(t + 0.5)), times.length, 6),
    qd_rad_s: f64(times.flatMap(() => six(1)), times.length, 6),
    qdd_rad_s2: null,
    torque_n_m: null,
    torque_limit_n_m: null,
    error_m: f64(times.map(() => 0.001), times.length),
    coverage: [],
  };
}

const SEGMENTS: PlanSegment[] = [
  { kind: "depart", plate: 7, t_start_s: 0, t_end_s: 2 },
  { kind: "wash", plate: 1, t_start_s: 2, t_end_s: 8 },
  { kind: "return", plate: 1, t_start_s: 8, t_end_s: 10 },
];

/** The joints' angles are the time. */
function viewWith(more: Partial<View>): View {
  return {
    motion: { t_s: f64([0, 10], 2), q_rad: f64([...six(0), ...six(10)], 2, 6), qd_rad_s: f64([...six(1), ...six(1)], 2, 6) },
    segments: SEGMENTS,
    plates: [{ name: "plate 3" }, { name: "plate 4" }] as Plate[],
    pose_rad: [1, 2, 3, 4, 5, 6],
    clearance: null,
    execution: null,
    live: null,
    ...more,
  } as View;
}

function played(more: Partial<View>): { player: Player; controls: Controls; clock: { now: number } } {
  const clock = { now: 0 };
  const player = new Player(viewWith(more));
  const controls = new Controls(player, () => clock.now, { changed: () => undefined, moved: () => undefined });
  return { player, controls, clock };
}

test("the arm follows the plan or the execution, and the other one is drawn beside it", () => {
  const { player, controls } = played({ execution: execution("simulated", [0, 4, 10]) });
  controls.seek(3);
  assert.deepEqual(Array.from(player.show().q).map((q) => Number(q.toFixed(9))), six(3));
  assert.equal(player.show().commanded, null);
  controls.follow("executed");
  assert.deepEqual(Array.from(player.show().q).map((q) => Number(q.toFixed(9))), six(3.5));
  assert.deepEqual(Array.from(player.show().commanded!).map((q) => Number(q.toFixed(9))), six(3));
});

test("without an execution only the plan can be followed", () => {
  const { player, controls } = played({});
  controls.follow("executed");
  assert.equal(player.follows, "planned");
});

test("a page of one configuration shows its pose and cannot be played", () => {
  const { player, controls } = played({ motion: null, segments: [] });
  controls.play();
  assert.equal(controls.playing, false);
  assert.deepEqual(Array.from(player.show().q), [1, 2, 3, 4, 5, 6]);
});

test("a plate is washed in its washing segment only", () => {
  const { player, controls } = played({});
  const washing = (t: number): number | null => {
    controls.seek(t);
    return player.show().washing;
  };
  assert.deepEqual([1, 2, 7.9, 8, 10].map(washing), [null, 1, 1, null, null]);
});

test("buttons step from segment to segment and back", () => {
  const { player, controls } = played({});
  const times: number[] = [];
  const at = (): void => void times.push(player.time);
  for (const direction of [1, 1, 1, 1, -1, -1, -1, -1] as const) {
    controls.toSegment(direction);
    at();
  }
  assert.deepEqual(times, [2, 8, 10, 10, 8, 2, 0, 0]);
  controls.seek(5);
  controls.toSegment(-1);
  assert.equal(player.time, 2);
});

test("a number key jumps to the plate with that number", () => {
  const { player, controls } = played({});
  assert.equal(controls.plateWith("4"), 1);
  assert.equal(controls.plateWith("9"), -1);
  assert.equal(controls.toPlate(1), 2);
  assert.equal(player.time, 2);
  assert.equal(controls.toPlate(-1), null);
  assert.equal(controls.toPlate(0), null);
});

const row = (t: number): number[] => [t, ...six(t), ...six(1), ...six(0), 0.002];

test("rows of the tests have as many columns as the server sends", () => {
  assert.equal(row(0).length, LIVE_COLUMNS);
});

function liveRun(): ReturnType<typeof played> & { runTo(seconds: number): void } {
  const run = played({ execution: execution("live", []), live: "events" });
  run.player.phase = "running";
  const runTo = (seconds: number): void => {
    for (; run.clock.now <= 1000 * seconds; run.clock.now += 20) {
      run.player.recording!.append([row(run.clock.now / 1000)]);
      run.player.tick(run.clock.now);
    }
  };
  return { ...run, runTo };
}

test("a live run is shown a moment behind its newest sample", () => {
  const { player, controls, runTo } = liveRun();
  runTo(3);
  assert.equal(controls.playing, true);
  assert.ok(player.time > 2.5 && player.time <= player.edge, `${player.time}`);
  assert.ok(Math.abs(player.show().q[0]! - player.time) < 1e-9);
});

test("a live run can be rewound while it goes on, and resumed", () => {
  const { player, controls, clock, runTo } = liveRun();
  runTo(3);
  controls.seek(1);
  assert.equal(player.newest, false);
  assert.equal(player.time, 1);
  controls.seek(99);
  assert.ok(player.time <= player.edge && player.edge < 3.1);
  controls.seek(1);
  runTo(5);
  assert.equal(player.time, 1);
  controls.toNewest();
  for (let k = 0; k < 5; k++) player.tick((clock.now += 20));
  assert.ok(player.time > 4.5, `${player.time}`);
});

test("played from behind, a live run is caught up with and followed", () => {
  const { player, controls, clock, runTo } = liveRun();
  runTo(3);
  controls.seek(1);
  controls.setSpeed(10);
  controls.play();
  for (let k = 0; k < 40; k++) player.tick((clock.now += 20));
  assert.equal(player.newest, true);
  assert.ok(player.time <= player.edge);
});

test("a finished live run stands at its end and plays like a film", () => {
  const { player, controls, clock, runTo } = liveRun();
  runTo(4);
  player.phase = "done";
  for (let k = 0; k < 100; k++) player.tick((clock.now += 20));
  assert.equal(player.newest, false);
  assert.ok(Math.abs(player.time - player.recording!.end) < 1e-9);
  assert.equal(controls.playing, false);
  controls.seek(10);
  assert.equal(player.time, 10);
});

test("a paused live run stays where it is", () => {
  const { player, controls, runTo } = liveRun();
  runTo(2);
  controls.pause();
  const { time } = player;
  runTo(3);
  assert.equal(player.time, time);
  assert.equal(controls.playing, false);
});

test("a new document keeps the time, within its film", () => {
  const view = viewWith({});
  const short = viewWith({ motion: { t_s: f64([0, 4], 2), q_rad: f64([...six(0), ...six(4)], 2, 6), qd_rad_s: f64([...six(1), ...six(1)], 2, 6) } });
  const player = new Player(view);
  player.seek(3, 0);
  player.play(0);
  player.replace(short, 0);
  assert.deepEqual([player.time, player.duration, player.clock.playing], [3, 4, true]);
  assert.equal(player.show().q[0], 3);
  player.tick(500);
  assert.equal(player.time, 3.5);
  player.pause(500);
  player.seek(9, 500);
  assert.equal(player.time, 4);
});

test("time and playing state are kept while there is no film", () => {
  const player = new Player(viewWith({}));
  player.seek(3, 0);
  player.play(0);
  player.replace(viewWith({ motion: null, segments: [] }), 0);
  assert.deepEqual([player.time, player.duration, player.clock.playing], [0, 0, false]);
  assert.deepEqual([...player.show().q], [1, 2, 3, 4, 5, 6]);
  player.replace(viewWith({ motion: null, segments: [] }), 0);
  player.replace(viewWith({}), 1000);
  assert.deepEqual([player.time, player.clock.playing], [3, true]);
  player.tick(1500);
  assert.equal(player.time, 3.5);
  player.replace(viewWith({ motion: null, segments: [] }), 1500);
  player.seek(7, 1500);
  player.replace(viewWith({}), 2000);
  assert.deepEqual([player.time, player.clock.playing], [7, false]);
});

/** The arm that is drawn is where the plan has it. */
import assert from "node:assert/strict";
import { dirname, join } from "node:path";
import { test } from "node:test";
import { rows, shipped } from "../lib/command.mjs";
import { address, open, seek } from "../lib/watched.mjs";

const TOLERANCE_M = 1e-4;

for (const scenario of ["kitchen", "paper-appendix"]) {
  test(`the tip of ${scenario} in the scene is the plan's`, async (t) => {
    const file = await shipped(scenario);
    // Computed by the command, from the same knots and another program's kinematics.
    const planned = await rows(join(dirname(file), "trajectory.csv"));
    const { page, quiet } = await open(t, address(file));
    await page.evaluate(() => window.platewash.follow?.("planned"));
    for (const share of [0.13, 0.5, 0.83]) {
      const row = planned[Math.round(share * (planned.length - 1))];
      await seek(page, Number(row.t_s));
      const tip = await page.evaluate(() => window.platewash.tip());
      const wanted = [row.tip_x_m, row.tip_y_m, row.tip_z_m].map(Number);
      const apart = Math.hypot(...tip.map((value, axis) => value - wanted[axis]));
      assert.ok(apart < TOLERANCE_M, `at ${row.t_s} s: ${tip} instead of ${wanted}`);
    }
    quiet();
  });
}

/** Places as changes of the scenario: one list, a section each, not at all. */
import assert from "node:assert/strict";
import { test } from "node:test";
import type { PlateMoves } from "../src/edit/protocol.ts";
import { placing, putting, together, unmoved, type Centre } from "../src/edit/placing.ts";
import { CELL, newCell, PLAN, PROOF, written } from "./fake-cell.ts";

/** The first plate has two faces, 20 mm apart along x. */
const SECTIONS: PlateMoves = { by: "sections", sections: [0, 0, 1], at_m: [[0.3, 0, 0.4], [0, 0.3, 0.03]] };
const WERE: Centre[] = [[0.3, 0], [0.28, 0], [0, 0.3]];

test("plates of one list are moved by it, those of sections by the key of each, heights kept", () => {
  assert.deepEqual(placing(undefined, [[0.1, 0.2]]), [{ key: "layout.positions_m", value: [[0.1, 0.2]] }]);
  assert.deepEqual(placing({ by: "positions" }, [[0.1, 0.2]]), [{ key: "layout.positions_m", value: [[0.1, 0.2]] }]);
  assert.deepEqual(placing(SECTIONS, [[0.35, 0.1], [0.33, 0.1], [0, 0.3]]), [
    { key: "plate[0].at_m", value: [0.35, 0.1, 0.4] },
    { key: "plate[1].at_m", value: [0, 0.3, 0.03] },
  ]);
});

test("the other face of a plate goes where the one that is moved goes", () => {
  assert.deepEqual(together(SECTIONS, WERE, [[0.3, 0], [0.38, -0.05], [0, 0.3]]), [[0.4, -0.05], [0.38, -0.05], [0, 0.3]]);
  assert.deepEqual(together(SECTIONS, WERE, [[0.31, 0], [0.28, 0], [0, 0.3]]), [[0.31, 0], [0.29, 0], [0, 0.3]]);
  const all: Centre[] = [[0.31, 0], [0.29, 0], [0, 0.31]];
  assert.deepEqual(together(SECTIONS, WERE, all), all);
  assert.deepEqual(together({ by: "positions" }, WERE, all), all);
});

test("what is not moved says why", () => {
  assert.equal(unmoved({ by: "positions" }, 7), null);
  assert.equal(unmoved(SECTIONS, 3), null);
  assert.match(unmoved(SECTIONS, 4)!, /\[\[plate\]\] section/);
  assert.equal(unmoved({ by: "nothing", words: "why" }, 3), "why");
  assert.deepEqual(putting({ key: null, at_m: [], words: "why" }, [0, 0]), []);
  assert.deepEqual(putting({ key: "obstacle[1].at_m", at_m: [1, 2, 3], words: null }, [0.5, 0.25]), [{ key: "obstacle[1].at_m", value: [0.5, 0.25, 3] }]);
  assert.deepEqual(putting({ key: "table.at_m", at_m: [1, 2], words: null }, [0.5, 0.25]), [{ key: "table.at_m", value: [0.5, 0.25] }]);
});

test("a drag of a plate, and of a body, is one step that names their sections", async () => {
  const moves = { plates: SECTIONS, bodies: [{ key: null, at_m: [], words: "floor" }, { key: "obstacle[0].at_m", at_m: [0.5, 0.5, 0.1], words: null }] };
  const { cell, channel } = newCell();
  cell.start();
  const answer = async (): Promise<void> => {
    const asked = channel.last("proof");
    asked.say({ kind: "scenario", text: written(asked.question), stated: {}, values: {}, ms: {} }, { ...CELL, centres_m: WERE, moves }, PLAN, PROOF);
    await asked.end();
  };
  await answer();
  for (let k = 1; k <= 5; k++) cell.drag([cell.centres[0]!, [0.28, -0.01 * k], cell.centres[2]!]);
  assert.deepEqual(cell.centres, [[0.3, -0.05], [0.28, -0.05], [0, 0.3]]);
  cell.drop("Move");
  assert.deepEqual(channel.last("proof").question.edits[0], { key: "plate[0].at_m", value: [0.3, -0.05, 0.4] });
  await answer();
  cell.dragBody({ body: 0, centre_m: [1, 1] });
  assert.equal(cell.dragging, false, "the floor stays");
  for (let k = 1; k <= 5; k++) cell.dragBody({ body: 1, centre_m: [0.5 + 0.01 * k, 0.4] });
  assert.deepEqual(cell.put, { body: 1, centre_m: [0.55, 0.4] });
  cell.drop("Move rack");
  assert.deepEqual(channel.last("proof").question.edits, [{ key: "obstacle[0].at_m", value: [0.55, 0.4, 0.1] }]);
  await answer();
  assert.equal(cell.put, null);
  assert.deepEqual([cell.history.at, cell.history.undoes], [2, "Move rack"]);
  cell.undo();
  assert.ok(!cell.text.includes("obstacle") && cell.text.includes("plate[0].at_m = [0.3,-0.05,0.4]"), cell.text);
  cell.place([...WERE, [1, 1]], "Add a plate");
  assert.equal(cell.history.at, 1, "no section, no plate");
});

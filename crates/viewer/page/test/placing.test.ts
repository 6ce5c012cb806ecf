/** Places as changes of the scenario: one list, a section each, not at all. */
import assert from "node:assert/strict";
import { test } from "node:test";
import type { BodyMove, PlateMoves } from "../src/edit/protocol.ts";
import { carrying, placing, putting, together, unmoved } from "../src/edit/placing.ts";
import type { Centre } from "../src/scene/handles.ts";
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

test("fixed bodies state the reason", () => {
  assert.equal(unmoved({ by: "positions" }, 7), null);
  assert.equal(unmoved(SECTIONS, 3), null);
  assert.match(unmoved(SECTIONS, 4)!, /\[\[plate\]\] section/);
  assert.equal(unmoved({ by: "nothing", words: "why" }, 3), "why");
  assert.deepEqual(putting({ key: null, at_m: [], words: "why", holds: [] }, [0, 0]), []);
  assert.deepEqual(putting({ key: "obstacle[1].at_m", at_m: [1, 2, 3], words: null, holds: [] }, [0.5, 0.25]), [{ key: "obstacle[1].at_m", value: [0.5, 0.25, 3] }]);
  assert.deepEqual(putting({ key: "table.at_m", at_m: [1, 2], words: null, holds: [] }, [0.5, 0.25]), [{ key: "table.at_m", value: [0.5, 0.25] }]);
});

test("a holder moves with its plates once all of them move alike", () => {
  const body = (index: number, holds: number[] | null): BodyMove => ({ key: `obstacle[${index}].at_m`, at_m: [0.5, index, 0.1], words: null, holds });
  const bodies = [body(0, [2]), body(1, [0, 1]), body(2, []), body(3, null), { ...body(4, [2]), key: null }];
  const at = (index: number): Centre => [0.5, index];
  const edits = (to: Centre[]): unknown => carrying(bodies, WERE, to, at);
  assert.deepEqual(edits([[0.3, 0], [0.28, 0], [0.1, 0.25]]), [{ key: "obstacle[0].at_m", value: [0.6, -0.05, 0.1] }]);
  assert.deepEqual(edits([[0.4, 0], [0.38, 0], [0, 0.3]]), [{ key: "obstacle[1].at_m", value: [0.6, 1, 0.1] }]);
  assert.deepEqual(edits([[0.4, 0], [0.28, 0], [0, 0.3]]), [], "one of two plates");
  const all = edits([[0.4, 0], [0.38, 0], [0.1, 0.3]]) as { key: string }[];
  assert.deepEqual(all.map(({ key }) => key), ["obstacle[0].at_m", "obstacle[1].at_m", "obstacle[3].at_m"]);
  assert.deepEqual(edits(WERE), []);
  assert.deepEqual(edits([...WERE, [1, 1]]), [], "a plate more");
  // An answer on the way has been drawn where the hand is: the body stays with its plate, and does not go back.
  const here: Centre[] = [[0.3, 0], [0.28, 0], [0.1, 0.25]];
  assert.deepEqual(carrying(bodies, here, here, at, WERE), [{ key: "obstacle[0].at_m", value: [0.5, 0, 0.1] }]);
});

test("a plate is dragged with its holder, in one step", async () => {
  const holder: BodyMove = { key: "obstacle[0].at_m", at_m: [0.05, 0.3, 0.1], words: null, holds: [2] };
  const { cell, channel } = newCell();
  cell.start();
  const asked = channel.last("proof");
  const drawn = { ...CELL, centres_m: WERE, moves: { plates: SECTIONS, bodies: [holder] } };
  asked.say({ kind: "scenario", text: written(asked.question), stated: {}, values: {}, ms: {} }, drawn, PLAN, PROOF);
  await asked.end();
  for (let k = 1; k <= 5; k++) cell.drag([WERE[0]!, WERE[1]!, [0.01 * k, 0.3]]);
  cell.drop("Move");
  assert.deepEqual(channel.last("proof").question.edits.slice(1), [
    { key: "plate[1].at_m", value: [0.05, 0.3, 0.03] },
    { key: "obstacle[0].at_m", value: [0.1, 0.3, 0.1] },
  ]);
  assert.equal(cell.history.at, 1);
});

test("a drag of a plate, and of a body, is one step that names their sections", async () => {
  const moves = { plates: SECTIONS, bodies: [{ key: null, at_m: [], words: "floor", holds: [] }, { key: "obstacle[0].at_m", at_m: [0.5, 0.5, 0.1], words: null, holds: [] }] };
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

import assert from "node:assert/strict";
import { test } from "node:test";
import { type Material, Mesh, MeshBasicMaterial, type WebGLRenderer } from "three";
import { keptOf } from "../src/scene/content.ts";
import { Retired } from "../src/scene/graph.ts";
import { Plates } from "../src/scene/plates.ts";
import { Studio } from "../src/scene/stage.ts";
import type { Plate, View } from "../src/view.ts";
import { irb120, pose, TOOL } from "./irb120.ts";

function plate(x: number, rim = 0.145): Plate {
  return { name: "plate", pose: pose([x, 0, 0.03]), surface: { meridian: "disc", radius_m: rim }, meridian_m: [[0, 0], [rim, 0]], thickness_m: 0.02 };
}

function view(): View {
  return {
    format: "platewash-view/2", version: "0",
    heading: { scenario: "", seed: 0, hash: null, process: "wash", dry_run: null, treatment: "swept", robot: "", duration_s: 0 },
    certificate: null, arm: irb120(pose([0, 0, 0])), tool: TOOL, surroundings: { obstacles: [], base_circle_m: 0.28, polygon_m: null },
    plates: [plate(0.3), plate(0.6)], paths: [], segments: [], motion: null, pose_rad: [0, 0, 0, 0, 0, 0], clearance: null, coverage: [],
    dirt: [],
    execution: null,
    beside: null, live: null,
  };
}

test("a document that says the same keeps all, but for an arm that is another object", () => {
  const before = view();
  const after = { ...structuredClone(before), arm: before.arm };
  assert.ok(Object.values(keptOf(before, after)).every((kept) => kept));
  const { arm, paths, extent, plates, floor, tool } = keptOf(before, structuredClone(before));
  assert.deepEqual({ arm, paths, extent, plates, floor, tool }, { arm: false, paths: false, extent: false, plates: true, floor: true, tool: true });
});

test("each change has made anew what depends on it, and nothing else", () => {
  const before = view();
  const cases: [Partial<View>, string[]][] = [
    [{ plates: [plate(0.31), plate(0.6)] }, ["plates", "paths", "extent"]],
    [{ tool: { ...TOOL, tip: pose([0, 0, 0.2]) } }, ["tool", "paths", "extent"]],
    [{ surroundings: { ...before.surroundings, base_circle_m: 0.3 } }, ["floor"]],
    [{ surroundings: { ...before.surroundings, polygon_m: [[0, 0], [1, 0], [1, 1]] } }, ["floor"]],
    [{ surroundings: { ...before.surroundings, obstacles: [{ name: "box", shape: { convex: { sphere: { radius_m: 0.1 } } }, pose: pose([1, 0, 0]) }] } }, ["obstacles", "extent"]],
    [{ pose_rad: [1, 0, 0, 0, 0, 0] }, ["extent"]],
    [{ paths: [{ plate: 0, points_m: { shape: [0, 3], f32: "" } }] }, ["paths"]],
    [{ heading: { ...before.heading, seed: 2 } }, []],
  ];
  for (const [change, anew] of cases) {
    const kept = keptOf(before, { ...before, ...change });
    assert.deepEqual(Object.entries(kept).filter(([, same]) => !same).map(([name]) => name).sort(), anew.sort(), Object.keys(change).join());
  }
});

/** A renderer that knows nothing but which programs materials use. */
class FakeRenderer {
  readonly used = new Map<Material, { usedTimes: number }>();
  readonly properties = { get: (material: Material) => ({ programs: this.used.has(material) ? new Map([["key", this.used.get(material)!]]) : undefined }) };
  freed = 0;

  /** A mesh whose material uses a program. */
  draw(program: { usedTimes: number }): Mesh {
    const material = new MeshBasicMaterial();
    this.used.set(material, program);
    program.usedTimes++;
    material.addEventListener("dispose", () => {
      program.usedTimes--;
      this.used.delete(material);
      this.freed++;
    });
    return new Mesh(undefined, material);
  }

  get bin(): Retired {
    return new Retired(this as unknown as WebGLRenderer);
  }
}

test("over a thousand replacements a program lives on, and one material more than is drawn at most", () => {
  const renderer = new FakeRenderer();
  const bin = renderer.bin;
  const program = { usedTimes: 0 };
  let shown = renderer.draw(program);
  for (let k = 0; k < 1000; k++) {
    bin.add(shown);
    // Now and then nothing of the kind is shown.
    if (k % 3 === 0) bin.free();
    shown = renderer.draw(program);
    bin.free();
    assert.ok(program.usedTimes >= 1 && renderer.used.size <= 2, `replacement ${k}: ${renderer.used.size} materials`);
  }
  bin.add(shown);
  bin.free();
  assert.equal(program.usedTimes, 1);
  assert.equal(renderer.freed, 1000);
});

test("plates of the same shape are moved, others made, and shapes that nobody has are freed", () => {
  const plates = new Plates(new Studio(), new FakeRenderer().bin);
  plates.replace([plate(0.3), plate(0.6)]);
  const [first, second] = plates.root.children;
  const shape = plates.shape(0)!;
  assert.equal(plates.shape(1), shape);
  plates.replace([plate(0.4), plate(0.6, 0.1), plate(0.9)]);
  assert.equal(plates.root.children[0], first);
  assert.ok(!plates.root.children.includes(second!) && plates.root.children.length === 3);
  assert.equal(plates.solids[0]!.pose.elements[12], 0.4);
  assert.equal(plates.shape(2), shape);
  let freed = false;
  shape.addEventListener("dispose", () => (freed = true));
  plates.replace([plate(0.6, 0.1)]);
  assert.ok(freed && plates.count === 1);
});

test("a displaced plate counts as moved until it is back", () => {
  const plates = new Plates(new Studio(), new FakeRenderer().bin);
  plates.replace([plate(0.3), plate(0.6)]);
  plates.move(1, [0.5, 0.1]);
  plates.move(7, [0.5, 0.1]);
  assert.deepEqual([...plates.moved], [1]);
  assert.deepEqual(plates.solids[1]!.pose.elements.slice(12, 15), [0.5, 0.1, 0.03]);
  plates.move(1, [0.6, 0]);
  assert.equal(plates.moved.size, 0);
  plates.move(1, [0.5, 0.1]);
  plates.replace([plate(0.3), plate(0.6)]);
  assert.equal(plates.moved.size, 0);
  assert.equal(plates.solids[1]!.pose.elements[12], 0.6);
});

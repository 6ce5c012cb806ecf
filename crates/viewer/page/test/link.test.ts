/** Links to scenarios: what goes in comes out, and damage is reported. */
import assert from "node:assert/strict";
import { test } from "node:test";
import { linkTo, parseLink } from "../src/address.ts";
import { scenarioFile } from "../src/playground/files.ts";
import { linkedCell, LinkError, packed, unpacked } from "../src/playground/link.ts";

const TEXTS = ["", "seed = 1\n", "# äöü € 𝄞 \u0000\r\n", "[[plate]]\nat_m = [0.3, 0]\n".repeat(3000)];

test("a text comes out of a link as it went in", async () => {
  for (const text of TEXTS) {
    const cell = await packed(text);
    assert.match(cell, /^[A-Za-z0-9_-]*$/);
    const hash = linkTo({ t: 1.5, speed: null, show: null, panel: "plots", camera: null }, { cell });
    assert.deepEqual(linkedCell(hash), { cell });
    assert.deepEqual(parseLink(hash), { t: 1.5, speed: null, show: null, panel: "plots", camera: null });
    assert.equal(await unpacked(cell), text);
  }
  assert.ok((await packed(TEXTS[3]!)).length < 1000, "it is compressed");
});

test("an address without a scenario names none, and a text goes before a name", () => {
  assert.equal(linkedCell(""), null);
  assert.equal(linkedCell("#t=3"), null);
  assert.deepEqual(linkedCell("#scenario=rack&t=3"), { scenario: "rack" });
  assert.deepEqual(linkedCell("#scenario=rack&cell=x"), { cell: "x" });
});

test("a damaged link is reported", async () => {
  const whole = await packed("seed = 1\n".repeat(50) + "name = \"a cell\"\n");
  const noText = Buffer.from([0x01, 0x01, 0x00, 0xfe, 0xff, 0xff]).toString("base64url");
  for (const cell of ["%", "AAAA", "not a link!", whole.slice(0, -6), `${whole.slice(0, 8)}${whole.slice(9)}`, noText]) {
    await assert.rejects(unpacked(cell), LinkError, cell);
  }
});

test("a link that grows beyond the longest scenario is refused before it fills the memory", async () => {
  const bomb = await packed("#".repeat(1 << 26));
  await assert.rejects(unpacked(bomb), /longer than 1 MiB/);
});

test("a scenario's file has a name that every system takes", () => {
  const named = (name: string): string => scenarioFile(`# a comment\nname = "${name}"\nseed = 1\n`);
  assert.equal(named("kitchen"), "kitchen.toml");
  assert.equal(named("../my cell: a/b"), "my-cell-a-b.toml");
  assert.equal(named("…"), "scenario.toml");
  assert.equal(named("Küche 2"), "Küche-2.toml");
  assert.equal(scenarioFile("seed = 1\n[[obstacle]]\nname = \"box\"\n"), "scenario.toml");
});

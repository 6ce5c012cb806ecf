/** Pages of others cannot make the server work, and a crowd does not bring it down. */
import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import { createServer } from "node:http";
import { connect } from "node:net";
import { test } from "node:test";
import { edit, settled, verdict } from "../lib/cell.mjs";
import { folder } from "../lib/command.mjs";

/** A page of another origin. */
async function foreign(test) {
  const server = createServer((_, answer) => answer.setHeader("Content-Type", "text/html").end("<!doctype html><title>foreign</title>"));
  await new Promise((resolve) => server.listen(0, "127.0.0.1", resolve));
  test.after(() => server.close());
  return `http://127.0.0.1:${server.address().port}/`;
}

test("a page of another origin can neither read nor make it plan", async (t) => {
  const { page, server } = await edit(t, await folder(t));
  const { token } = server;
  const other = await page.context().newPage();
  await other.goto(await foreign(t));
  const tried = await other.evaluate(
    async ({ url, token }) => {
      const question = { session: "evil", text: "", edits: [], want: "proof", arm: null };
      const body = JSON.stringify(question);
      const ways = [
        { method: "GET" },
        { method: "POST", body },
        { method: "POST", body, mode: "no-cors" },
        { method: "POST", body, headers: { "Content-Type": "application/json", "X-Platewash-Token": token } },
        { method: "POST", body, mode: "no-cors", headers: { "Content-Type": "text/plain" } },
      ];
      const results = [];
      for (const path of ["cell", "map", "save", "disk", "hello", ""]) {
        for (const way of ways) {
          try {
            const answer = await fetch(url + path, way);
            results.push(`${answer.type} ${answer.status} ${(await answer.text()).length}`);
          } catch {
            results.push("refused");
          }
        }
      }
      return results;
    },
    { url: `${server.origin}/`, token },
  );
  // What is not refused is opaque: nothing of it can be read.
  assert.deepEqual(new Set(tried.filter((way) => !way.startsWith("opaque 0 0"))), new Set(["refused"]));
  const { status, words } = await raw(server.url, "POST", "cell", { Origin: "http://evil.example", "X-Platewash-Token": token }, "{}");
  assert.equal(status, 403, words);
});

/** A request as nobody's page sends it. */
function raw(url, method, path, headers, body, { slow = false } = {}) {
  const { hostname, port } = new URL(url);
  return new Promise((resolve) => {
    const socket = connect(Number(port), hostname);
    let said = "";
    const end = () => resolve({ status: Number(/^HTTP\/1\.1 (\d+)/.exec(said)?.[1] ?? 0), words: said });
    socket.setTimeout(300_000, () => socket.destroy());
    socket.on("error", end);
    socket.on("close", end);
    socket.on("connect", () => {
      const all = { Host: `${hostname}:${port}`, "Content-Length": String(body.length), "Content-Type": "application/json", ...headers };
      const head = Object.entries(all).map(([name, value]) => `${name}: ${value}\r\n`);
      socket.write(`${method} /${path} HTTP/1.1\r\n${head.join("")}\r\n`);
      socket.write(body);
    });
    if (slow) socket.pause();
    else socket.on("data", (chunk) => (said += chunk.toString("latin1").slice(0, 2000)));
    if (slow) setTimeout(() => socket.destroy(), 8000);
  });
}

/** Memory of a process that is in use [MB]; null where the system does not say. */
async function resident(pid) {
  const text = await readFile(`/proc/${pid}/status`, "utf8").catch(() => null);
  const found = text === null ? null : /VmRSS:\s+(\d+) kB/.exec(text);
  return found === null ? null : Number(found[1]) / 1000;
}

test("of a thousand requests at once each is answered or refused, and the page is answered afterwards", { timeout: 900_000 }, async (t) => {
  const { page, server } = await edit(t, await folder(t));
  const { text } = await page.evaluate(() => JSON.parse(document.getElementById("platewash-edit").textContent));
  const headers = { Origin: server.origin, "X-Platewash-Token": server.token };
  const question = (k) => JSON.stringify({ session: `s${k}`, text, edits: [{ key: "seed", value: k }], want: "proof", arm: null });
  let most = 0;
  const watch = setInterval(async () => (most = Math.max(most, (await resident(server.pid)) ?? 0)), 50);
  const slow = raw(server.url, "POST", "cell", headers, question(9999), { slow: true });
  const asked = Array.from({ length: 1000 }, (_, k) => {
    switch (k % 6) {
      case 0: return raw(server.url, "POST", "cell", headers, question(k).slice(0, -20));
      case 1: return raw(server.url, "POST", "cell", { ...headers, "Content-Length": "999999999999" }, "{");
      case 2: return raw(server.url, "POST", "cell", { ...headers, "X-Big": "a".repeat(60_000) }, "{}");
      default: return raw(server.url, "POST", "cell", headers, question(k));
    }
  });
  const statuses = (await Promise.all(asked)).map(({ status }) => status);
  const count = (wanted) => statuses.filter((status) => status === wanted).length;
  const known = [0, 200, 400, 408, 413, 431, 503];
  assert.deepEqual(statuses.filter((status) => !known.includes(status)), []);
  assert.ok(count(200) > 0, `${statuses.slice(0, 40)}`);
  const began = Date.now();
  await page.evaluate(() => window.platewash.edit.change([{ key: "seed", value: 5 }]));
  await settled(page);
  assert.equal((await verdict(page)).kind, "proved");
  t.diagnostic(`answered ${count(200)}, busy ${count(503)}, closed ${count(0)}; ${most.toFixed(0)} MB at most; afterwards ${Date.now() - began} ms`);
  clearInterval(watch);
  assert.ok(most < 300, `${most} MB`);
  await slow;
});

/** A scenario's name is text, whatever is in it. */
import assert from "node:assert/strict";
import { test } from "node:test";
import { folder, kitchen, page as written } from "../lib/command.mjs";
import { address, open } from "../lib/watched.mjs";

const NAMES = {
  "a script, a placeholder and quotes": `</script><script>window.stolen = 1</script><img src=x onerror="window.stolen = 2"><!--platewash:script--><!--platewash:data-->$&$1"'\`&quot;&lt;b&gt; \${1} {{2}} %3C<!--`,
  "right to left, and ten thousand letters": "שטיפה gnihsaw غسل " + "washing".repeat(1427),
};

for (const [what, name] of Object.entries(NAMES)) {
  test(`${what} in a scenario's name is shown as text`, async (t) => {
    const place = await folder(t);
    const scenario = await kitchen(place, ['name = "kitchen"', `name = ${JSON.stringify(name)}`], ["count = 4", "count = 1"]);
    const { page, quiet } = await open(t, address(await written(place, scenario)));
    const found = await page.evaluate(() => ({
      shown: document.body.textContent,
      named: window.platewash.view.heading.scenario,
      stolen: window.stolen,
      wide: document.documentElement.scrollWidth - innerWidth,
    }));
    assert.equal(found.named, name);
    assert.ok(found.shown.includes(name.slice(0, 40)), "the name is not in the page");
    assert.equal(found.stolen, undefined);
    assert.ok(found.wide <= 0, `the page is ${found.wide} px too wide`);
    quiet();
  });
}

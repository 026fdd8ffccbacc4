// SPDX-License-Identifier: BSD-3-Clause
// The page that a clone has: one click and one drag bend a sample. clone_test.mjs BROWSER PAGE VERSION
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { pathToFileURL } from "node:url";
import { largestDifference, launch, Page } from "../browser/page.mjs";

const [executablePath, path, version] = process.argv.slice(2);
const text = readFileSync(path, "utf8");
assert.ok(text.includes(`libflbc ${version}.`), `${path} is not of version ${version}; make it by scripts/web.sh`);
assert.ok(text.length <= 2.6e6, `${path} has ${text.length} bytes, more than 2.6 MB`);
for (const name of ["tetgen", "cgal", "eigen3", "nlohmann-json3", "pugixml"]) assert.match(text, new RegExp(`${name} \\d`));

class Clone extends Page {
  loaded() {
    return this.tab.waitForFunction(() => globalThis.flbcApp);
  }
}

const browser = await launch(executablePath);
const page = await new Clone().open(browser, pathToFileURL(path).href);
await page.tab.click("[data-sample='character.obj']");
await page.tab.waitForFunction(() => document.getElementById("app").hidden && window.flbc.milliseconds() >= 0,
                               { timeout: 120000 });
const rest = await page.points();
const i = await page.touchable();
await page.drag(await page.ask("spot", i), 40, -30);
const most = largestDifference(await page.points(), rest);
assert.ok(most > 0.01 * Math.max(...rest.map(Math.abs)), `the farthest vertex moved by ${most}`);
await page.close();
await browser.close();

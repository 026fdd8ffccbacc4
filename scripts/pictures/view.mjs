// SPDX-License-Identifier: BSD-3-Clause
// The page of the limb with its hand turned: view.mjs PAGE PICTURE. Takes puppeteer-core from
// tests/browser.
import { createRequire } from "node:module";
import { resolve } from "node:path";

const [page, picture] = process.argv.slice(2).map((path) => resolve(path));
const tests = new URL("../../tests/browser/package.json", import.meta.url);
const { default: puppeteer } = await import(createRequire(tests).resolve("puppeteer-core"));

const browser = await puppeteer.launch({
  executablePath: "/usr/bin/chromium",
  args: ["--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"] });
const tab = await browser.newPage();
await tab.setViewport({ width: 1600, height: 900 });
await tab.goto(`file://${page}`);
await tab.waitForFunction(() => window.flbc?.milliseconds() >= 0);
await tab.evaluate(() => {
  const [first, last, wrist, angle] = [30, 53, [4, 1.2], 0.75];
  const hand = [];
  for (let i = first; i <= last; ++i) if (window.flbc.controlPoint(i)[0] > 0) hand.push(i);
  for (const i of hand) {
    const place = window.flbc.controlPoint(i);
    const [x, y] = [place[0] - wrist[0], place[1] - wrist[1]];
    window.flbc.move(i, [wrist[0] + Math.cos(angle) * x - Math.sin(angle) * y,
                         wrist[1] + Math.sin(angle) * x + Math.cos(angle) * y, place[2]]);
  }
  window.flbc.select(hand);
});
await tab.click("#rotate");
await tab.mouse.move(650, 380);
await tab.mouse.wheel({ deltaY: -90 });
await tab.screenshot({ path: picture });
await browser.close();

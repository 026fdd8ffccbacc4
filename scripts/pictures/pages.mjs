// SPDX-License-Identifier: BSD-3-Clause
// Pages as they look during work: pages.mjs LIMB_PAGE APP_PAGE FOLDER, for pages.py.
import { join } from "node:path";
import { launch, Page } from "../../tests/browser/page.mjs";

const [limb, app, folder] = process.argv.slice(2);
const viewport = { width: 1200, height: 800 };
const browser = await launch("/usr/bin/chromium");

// Selects the control points beyond a joint, and rotates them about it.
function bend(page, axis, joint, degrees) {
  return page.tab.evaluate((d, [x0, y0], angle) => {
    const beyond = [];
    for (let i = 0; window.flbc.controlPoint(i).every(Number.isFinite); ++i) {
      const [x, y, z] = window.flbc.controlPoint(i);
      if ([x, y, z][d] < [x0, y0][d]) continue;
      beyond.push(i);
      window.flbc.move(i, [x0 + Math.cos(angle) * (x - x0) - Math.sin(angle) * (y - y0),
                           y0 + Math.sin(angle) * (x - x0) + Math.cos(angle) * (y - y0), z]);
    }
    window.flbc.select(beyond);
  }, axis, joint, degrees * Math.PI / 180);
}

async function take(page, name) {
  await page.picture();  // two frames later
  await page.tab.screenshot({ path: join(folder, `${name}.png`) });
  await page.close();
}

class App extends Page {
  loaded() {
    return this.tab.waitForFunction(() => globalThis.flbcApp);
  }
}

async function openSample(name) {
  const page = await new App().open(browser, `file://${app}`, { viewport });
  await page.tab.click(`[data-sample='${name}.obj']`);
  await page.tab.waitForFunction(
    () => document.getElementById("app").hidden && window.flbc.milliseconds() >= 0, { timeout: 240000 });
  return page;
}

const view = await new Page().open(browser, `file://${limb}`, { viewport });
await bend(view, 0, [4.1, 1.2], 45);
await view.press("rotate");
await take(view, "view");

const bent = await openSample("character");
await bend(bent, 0, [1.6, 2.4], 55);
await bent.press("rotate");
await take(bent, "browser");

const protect = await openSample("limb");
await bend(protect, 0, [4.1, 1.2], 0);
await protect.tab.click("#protectSection summary");
await protect.press("paint");
const spot = { x: 330, y: 470 };  // on the upper arm
for (const dy of [-12, 12]) await protect.drag({ x: spot.x, y: spot.y + dy }, 90, 0, 12);
await protect.tab.waitForFunction(() => !document.getElementById("solving").textContent, { timeout: 60000 }).catch(() => {});
await take(protect, "protect");
await browser.close();

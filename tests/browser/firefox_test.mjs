// SPDX-License-Identifier: BSD-3-Clause
// Pages of flbc view under a mouse in Firefox: firefox_test.mjs FIREFOX PROGRAM MESHES WORK
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import puppeteer from "puppeteer-core";

const [executablePath, program, meshes, work] = process.argv.slice(2);

// With a window: Firefox draws by software only where there is a display.
const browser = await puppeteer.launch({
  browser: "firefox", executablePath, headless: false, protocolTimeout: 120000,
  extraPrefsFirefox: { "webgl.force-enabled": true, "gfx.webrender.software": true,
                       "privacy.reduceTimerPrecision": false } });

function vertices(path, dim) {
  return readFileSync(path, "utf8").split("\n").filter((line) => line.startsWith("v "))
    .flatMap((line) => line.split(/\s+/).slice(1, dim + 1).map(Number));
}

function largestDifference(a, b) {
  assert.equal(a.length, b.length);
  return a.reduce((most, value, k) => Math.max(most, Math.abs(value - b[k])), 0);
}

class Page {
  static async open(name) {
    const page = new Page();
    page.failures = [];
    page.tab = await browser.newPage();
    page.tab.on("pageerror", (error) => page.failures.push(error.message));
    page.tab.on("console", (line) => {
      if (line.type() === "error") page.failures.push(line.text());
    });
    await page.tab.setViewport({ width: 1200, height: 800 });
    await page.tab.goto(`file://${work}/${name}.html`);
    await page.tab.waitForFunction(() => window.flbc?.milliseconds() >= 0);
    return page;
  }

  ask(action, ...values) {
    return this.tab.evaluate((name, list) => {
      const answer = window.flbc[name](...list);
      return ArrayBuffer.isView(answer) ? Array.from(answer) : answer;
    }, action, values);
  }

  async grabbable(count) {
    for (let i = 0; i < count; ++i) {
      const spot = await this.ask("spot", i);
      await this.tab.mouse.click(spot.x, spot.y);
      if ((await this.ask("selection")).join() === String(i)) return i;
    }
    return assert.fail("no control point can be clicked");
  }

  async drag(i, dx, dy) {
    const { mouse } = this.tab;
    const spot = await this.ask("spot", i);
    await mouse.move(spot.x, spot.y);
    await mouse.down();
    await mouse.move(spot.x + dx, spot.y + dy, { steps: 6 });
    await mouse.up();
  }

  async picture(file) {
    await this.tab.evaluate(() => new Promise((done) => {
      requestAnimationFrame(() => requestAnimationFrame(done));
    }));
    const data = await this.tab.screenshot();
    writeFileSync(join(work, file), data);
    return Buffer.from(data).toString("base64");
  }

  // The number of colors in a picture.
  colours(base64) {
    return this.tab.evaluate(async (data) => {
      const image = new Image();
      image.src = `data:image/png;base64,${data}`;
      await image.decode();
      const context = new OffscreenCanvas(image.width, image.height).getContext("2d");
      context.drawImage(image, 0, 0);
      const { data: pixels } = context.getImageData(0, 0, image.width, image.height);
      return new Set(new Uint32Array(pixels.buffer)).size;
    }, base64);
  }
}

async function testDrag(dim, name) {
  const page = await Page.open(name);
  const cage = join(meshes, `${dim}d`, `${name}_cage.obj`);
  const model = join(meshes, `${dim}d`, `${name}_model.obj`);
  const at = vertices(model, dim);
  const size = Math.max(...at) - Math.min(...at);
  const rest = await page.ask("points");
  assert.ok(largestDifference(rest, at) <= 1e-6 * size, "at rest");
  const before = await page.picture(`${name}_rest.png`);
  assert.ok(await page.colours(before) > 100, "the picture is blank");

  const i = await page.grabbable(vertices(cage, dim).length / dim);
  await page.drag(i, 60, -45);
  const moved = await page.ask("points");
  assert.ok(largestDifference(moved, rest) > 1e-3 * size, "nothing moved");
  assert.notEqual(await page.picture(`${name}_moved.png`), before);
  const pose = join(work, `${name}_pose.obj`), posed = join(work, `${name}_posed.obj`);
  writeFileSync(pose, await page.ask("pose"));
  execFileSync(program, ["deform", model, "--weights", join(work, `${name}.mtx`), "--pose", pose,
                         "-q", "-o", posed]);
  assert.ok(largestDifference(moved, vertices(posed, dim)) <= 1e-6 * size,
            "flbc deform puts the model elsewhere");
  await page.tab.click("#undo");
  assert.deepEqual(await page.ask("points"), rest);
  assert.deepEqual(page.failures, []);
  await page.tab.close();
  console.log(`${name}: as flbc deform, in ${await browser.version()}`);
}

try {
  await testDrag(2, "figure");
  await testDrag(3, "limb");
} finally {
  await browser.close();
}

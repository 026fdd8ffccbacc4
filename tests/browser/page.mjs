// SPDX-License-Identifier: BSD-3-Clause
// Pages of flbc view in a browser, and what tests ask of them.
import assert from "node:assert/strict";
import { readFileSync, writeFileSync } from "node:fs";
import puppeteer from "puppeteer-core";

// Chromium must be asked for software rendering of WebGL. Firefox has it only with a display.
function launchAny(executablePath, options) {
  if (!executablePath.includes("firefox")) {
    return puppeteer.launch({
      executablePath, protocolTimeout: 240000,
      args: ["--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", ...options] });
  }
  return puppeteer.launch({
    browser: "firefox", executablePath, headless: false, protocolTimeout: 240000,
    extraPrefsFirefox: { "webgl.force-enabled": true, "gfx.webrender.software": true,
                         "privacy.reduceTimerPrecision": false } });
}

// A browser whose pages may take long to load, because tests run side by side.
export async function launch(executablePath, ...options) {
  const browser = await launchAny(executablePath, options);
  const newPage = browser.newPage.bind(browser);
  browser.newPage = async () => {
    const tab = await newPage();
    tab.setDefaultNavigationTimeout(180000);
    return tab;
  };
  return browser;
}

export function vertices(path, dim) {
  return readFileSync(path, "utf8").split("\n").filter((line) => line.startsWith("v "))
    .flatMap((line) => line.trim().split(/\s+/).slice(1, dim + 1).map(Number));
}

export function sizeOf(points, dim) {
  const extents = Array.from({ length: dim }, (_, k) => {
    const values = points.filter((_, j) => j % dim === k);
    return Math.max(...values) - Math.min(...values);
  });
  return Math.hypot(...extents);
}

export function largestDifference(a, b) {
  assert.equal(a.length, b.length);
  return a.reduce((most, value, k) => Math.max(most, Math.abs(value - b[k])), 0);
}

// The pixels of a PNG, decoded by the browser: a number of 32 bits each, red in the lowest 8.
// They come as Base64, because a list of a million numbers takes the browser seconds to send.
export async function pixelsOf(tab, base64) {
  const url = await tab.evaluate(async (data) => {
    const image = new Image();
    image.src = `data:image/png;base64,${data}`;
    await image.decode();
    const context = new OffscreenCanvas(image.width, image.height).getContext("2d");
    context.drawImage(image, 0, 0);
    const { data: pixels } = context.getImageData(0, 0, image.width, image.height);
    const reader = new FileReader();
    reader.readAsDataURL(new Blob([pixels]));
    await new Promise((done) => { reader.onload = done; });
    return reader.result;
  }, base64);
  const bytes = Buffer.from(url.slice(url.indexOf(",") + 1), "base64");
  return new Uint32Array(new Uint8Array(bytes).buffer);
}

export class Page {
  async open(browser, url, { theme, viewport = { width: 1200, height: 800 } } = {}) {
    this.tab = await browser.newPage();
    this.url = url;
    this.failures = [];
    this.requests = [];
    this.tab.on("request", (request) => this.requests.push(request.url()));
    this.tab.on("pageerror", (error) => this.failures.push(error.message));
    this.tab.on("console", (line) => {
      if (line.type() === "error") this.failures.push(line.text());
    });
    await this.tab.setViewport(viewport);
    if (theme) {
      await this.tab.emulateMediaFeatures([{ name: "prefers-color-scheme", value: theme }]);
    }
    await this.tab.goto(url);
    await this.loaded();
    return this;
  }

  loaded() {
    return this.tab.waitForFunction(() => window.flbc?.milliseconds() >= 0);
  }

  ask(action, ...values) {
    return this.tab.evaluate((name, list) => {
      const answer = window.flbc[name](...list);
      return ArrayBuffer.isView(answer) ? Array.from(answer) : answer;
    }, action, values);
  }

  points() {
    return this.ask("points");
  }

  press(id) {
    return this.tab.click(`#${id}`);
  }

  state() {
    return this.tab.$eval("#state", (element) => element.textContent);
  }

  async type(keys) {
    for (const key of keys) await this.tab.keyboard.press(key);
  }

  // A control point that can be dragged without selecting it first.
  async touchable(accepts = () => true) {
    for (let i = 0; ; ++i) {
      const spot = await this.ask("spot", i);
      await this.tab.mouse.move(spot.x, spot.y);
      if ((await this.state()).startsWith(`control point ${i} `) && await accepts(i)) return i;
    }
  }

  // A control point that can be clicked.
  async grabbable() {
    for (let i = 0; ; ++i) {
      const spot = await this.ask("spot", i);
      await this.tab.mouse.click(spot.x, spot.y);
      if ((await this.ask("selection")).join() === String(i)) return i;
    }
  }

  async drag(from, dx, dy, steps = 6) {
    const { mouse } = this.tab;
    await mouse.move(from.x, from.y);
    await mouse.down();
    await mouse.move(from.x + dx, from.y + dy, { steps });
    await mouse.up();
  }

  // The picture of the model and its cage as rows of pixels.
  async picture(path) {
    await this.tab.evaluate(() => new Promise((done) => {
      requestAnimationFrame(() => requestAnimationFrame(done));
    }));
    const stage = await this.tab.$("#canvas");
    const base64 = await stage.screenshot({ encoding: "base64" });
    if (path) writeFileSync(path, Buffer.from(base64, "base64"));
    return pixelsOf(this.tab, base64);
  }

  // Forgets the pose, which the browser would keep for the next page of this model.
  async close() {
    await this.tab.evaluate(() => localStorage.clear());
    assert.deepEqual(this.failures, []);
    const others = this.requests.filter(
      (url) => !/^(file|data|blob):/.test(url) && !url.startsWith(this.url));
    assert.deepEqual(others, [], "the page asks for something on the network");
    return this.tab.close();
  }
}

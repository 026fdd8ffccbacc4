// SPDX-License-Identifier: BSD-3-Clause
// flbc.html from its file, by real events: page_test.mjs BROWSER PAGE PROGRAM MESHES WORK
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { existsSync, mkdirSync, readdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { basename, join } from "node:path";
import { setTimeout as sleep } from "node:timers/promises";
import { fileURLToPath, pathToFileURL } from "node:url";
import { largestDifference, launch, Page, vertices } from "../browser/page.mjs";

const [executablePath, pagePath, program, meshes, work] = process.argv.slice(2);
const browser = await launch(executablePath);
const url = pathToFileURL(pagePath).href;
const here = fileURLToPath(new URL(".", import.meta.url));
const downloads = join(work, "downloads");
rmSync(downloads, { recursive: true, force: true });
mkdirSync(downloads, { recursive: true });

class App extends Page {
  async loaded() {
    await this.tab.waitForFunction(() => globalThis.flbcApp);
    const session = await this.tab.createCDPSession();
    await session.send("Browser.setDownloadBehavior", { behavior: "allow", downloadPath: downloads });
  }

  shown() {
    return this.tab.waitForFunction(() => document.getElementById("app").hidden && window.flbc.milliseconds() >= 0,
                                    { timeout: 120000 });
  }

  // Drops files as a person does, which browsers let no script do for them but by its own files.
  drop(files) {
    const given = files.map((file) => ({ name: basename(file), data: readFileSync(file).toString("base64") }));
    return this.tab.evaluate((list) => {
      const transfer = new DataTransfer();
      for (const { name, data } of list) {
        transfer.items.add(new File([Uint8Array.from(atob(data), (letter) => letter.charCodeAt(0))], name));
      }
      document.getElementById("drop").dispatchEvent(new DragEvent("drop", { dataTransfer: transfer, bubbles: true, cancelable: true }));
    }, given);
  }

  text(id) {
    return this.tab.$eval(`#${id}`, (element) => element.textContent);
  }

  // Opens a folded part of the panel.
  unfold(id) {
    return this.tab.$eval(`#${id}`, (part) => { part.open = true; });
  }

  // The stage is seen, as long as the model is.
  shot(name) {
    return this.tab.screenshot({ path: join(work, `${name}.png`) });
  }

  async saved(selector, name) {
    const path = join(downloads, name);
    await this.tab.$eval(selector, (button) => button.click());
    for (let k = 0; k < 100 && !existsSync(path); ++k) await sleep(100);
    await sleep(200);
    return path;
  }

  // A drag of a control point, by the mouse.
  async moveOne(dx, dy) {
    const i = await this.grabbable();
    await this.drag(await this.ask("spot", i), dx, dy);
    return i;
  }
}

// The start screen needs nothing of what is unpacked after its first frame, which is never reported here.
async function testStart() {
  const tab = await browser.newPage();
  await tab.evaluateOnNewDocument(() => { globalThis.PerformanceObserver = class { observe() {} }; });
  await tab.goto(url);
  await tab.waitForFunction(() => performance.getEntriesByName("first-contentful-paint").length > 0);
  assert.ok(await tab.$eval("#drop", (zone) => zone.getClientRects().length > 0));
  assert.equal(await tab.evaluate(() => typeof globalThis.flbcApp), "undefined");
  await tab.close();
}

// Files that are dropped as soon as the start screen is there, before the program.
async function testEarlyDrop(file) {
  const tab = await browser.newPage();
  await tab.evaluateOnNewDocument((name, text) => {
    addEventListener("DOMContentLoaded", () => {
      const dataTransfer = new DataTransfer();
      dataTransfer.items.add(new File([text], name));
      const event = new DragEvent("drop", { dataTransfer, bubbles: true, cancelable: true });
      globalThis.early = { isRefused: !document.getElementById("drop").dispatchEvent(event), hasProgram: "flbcApp" in globalThis };
    });
  }, basename(file), readFileSync(file, "utf8"));
  await tab.goto(url);
  await tab.waitForFunction(() => globalThis.flbcApp && document.getElementById("app").hidden && window.flbc?.milliseconds() >= 0,
                            { timeout: 120000 });
  assert.deepEqual(await tab.evaluate(() => globalThis.early), { isRefused: true, hasProgram: false });
  assert.ok((await tab.title()).includes(basename(file, ".obj")));
  await tab.close();
}

// The pose that the page saves moves the model as flbc deform does.
async function testModel(sample, file, dim) {
  const app = await new App().open(browser, url);
  assert.ok((await app.text("samples")).includes(sample));
  await app.shot(`${dim}d_start`);
  await app.drop([file]);
  await app.shown();
  const rest = vertices(file, dim);
  const size = Math.max(...rest) - Math.min(...rest);
  assert.ok(largestDifference(await app.points(), rest) < 1e-5 * size);
  await app.moveOne(40, -30);
  await app.shot(`${dim}d_moved`);
  const title = basename(file, ".obj");
  const posed = await app.saved("[data-save=posed]", `${title}_posed.obj`);
  const pose = await app.saved("#savePose", `${title}_pose.obj`);
  const weights = await app.saved("[data-save=npy]", `${title}_weights.npy`);
  const cage = await app.saved("[data-save=cage]", `${title}_cage.obj`);
  const out = join(work, `${dim}d.obj`);
  execFileSync(program, ["deform", file, "--weights", weights, "--pose", pose, "--rest", cage, "-q", "-o", out]);
  const moved = vertices(out, dim);
  assert.ok(largestDifference(moved, rest) > 1e-3 * size, "nothing moved");
  assert.ok(largestDifference(vertices(posed, dim), moved) < 1e-9 * size);
  // The page keeps 16 influences per vertex.
  assert.ok(largestDifference(await app.points(), moved) < 5e-3 * size);
  const rig = await app.saved("[data-save=glb4]", `${title}.glb`);
  assert.match(String(execFileSync(program, ["info", rig])), /skin of \d+ joints/);

  // Two keys are an animation of two seconds.
  await app.type("k");
  await app.press("undo");
  await app.type("k");
  const animated = await app.saved("#saveAnimation", `${title}_animation.glb`);
  assert.match(String(execFileSync(program, ["info", animated])), /animation of 2 s/);
  await app.shot(`${dim}d_keys`);
  for (let k = 0; k < 2; ++k) await app.press("removeKey");
  await app.press("redo");
  const page = await app.saved("[data-save=page]", `${title}.html`);
  assert.match(readFileSync(page, "utf8"), /<html/);

  // Harmonic coordinates move more vertices.
  await app.unfold("compareSection");
  await app.press("harmonic");
  await app.tab.waitForFunction(() => /harmonic/.test(document.getElementById("share").textContent));
  const [local, harmonic] = (await app.text("share")).match(/[\d.]+/g).map(Number);
  assert.ok(harmonic >= local && local > 0, `${local}% and ${harmonic}%`);
  await app.press("local");
  await app.shot(`${dim}d_compared`);

  // The rest cage is reshaped; the model stays.
  await app.press("resetAll");
  await sleep(300);  // until the shares have changed, which moves the buttons
  await app.unfold("reshapeSection");
  await app.press("reshape");
  await app.moveOne(12, -8);
  await app.tab.waitForFunction(() => !window.flbc.viewer.reshaper.isBusy, { timeout: 60000 });
  assert.ok(largestDifference(await app.points(), rest) < 1e-5 * size);
  await app.press("reshape");

  // A refused cage leaves the reshaped one and its weights.
  const reshaped = await app.tab.evaluate(() => [...window.flbc.viewer.editor.rest]);
  const bad = join(work, "bad_cage.obj");
  writeFileSync(bad, "v 0 0 zero\n");
  await app.drop([bad]);
  await app.tab.waitForSelector("#cageProblem:not([hidden])");
  assert.deepEqual(await app.tab.$eval("#cageSection", (part) => part.open), true);
  rmSync(cage);
  const kept = vertices(await app.saved("[data-save=cage]", `${title}_cage.obj`), 3);
  assert.ok(largestDifference(kept, reshaped) < 1e-9 * size, "another cage than the one that is seen");

  // Another cage.
  await app.tab.type("#count", "60");
  await app.tab.$eval("[data-do=makeCage]", (button) => button.click());
  await sleep(300);
  await app.shot(`${dim}d_busy`);
  await app.shown();
  const count = await app.tab.evaluate(() => window.flbc.viewer.editor.size);
  assert.ok(count > 50 && count <= 60, `${count} control points`);
  const [a, b] = await app.tab.evaluate(() => [...window.flbc.viewer.content.edges.slice(0, 2)]);
  for (const [button, expected] of [["split", count + 1], ["merge", count]]) {
    await app.ask("select", button === "split" ? [a, b] : [a, count]);
    await app.tab.$eval(`[data-do=${button}]`, (element) => element.click());
    await app.tab.waitForFunction((size) => window.flbc.viewer.editor.size === size, { timeout: 60000 }, expected);
    await app.shown();
  }
  await app.close();
}

async function testErrors() {
  const app = await new App().open(browser, url, { theme: "dark" });
  const isStill = () => app.tab.$eval("#moving", (picture) => picture.animationsPaused());
  assert.equal(await isStill(), false);
  await app.tab.emulateMediaFeatures([{ name: "prefers-color-scheme", value: "dark" }, { name: "prefers-reduced-motion", value: "reduce" }]);
  await app.tab.reload();
  await app.loaded();
  assert.equal(await isStill(), true);
  const bad = join(work, "bad.obj");
  writeFileSync(bad, "v 0 0 zero\n");
  await app.drop([bad]);
  await app.tab.waitForSelector("#problem:not([hidden])");
  assert.match(await app.text("problem"), /bad.obj:1: expected a number, found "zero"/);
  await app.shot("dark_problem");

  // Cancelled, and what comes next works.
  await app.drop([join(meshes, "3d/limb_model.obj")]);
  await app.tab.waitForFunction(() => document.getElementById("stages").children.length > 1);
  await app.shot("dark_busy");
  const stages = await app.tab.$eval("[data-do=cancel]", (button) => {
    button.click();
    return document.getElementById("stages").children.length;
  });
  await app.tab.waitForFunction(() => !document.getElementById("start").hidden);
  assert.equal(await app.tab.$eval("#stages", (list) => list.children.length), stages);
  await app.drop([join(meshes, "3d/limb_model.obj")]);
  await app.shown();

  // A cage with a hole is shown with its defects, and repaired.
  const cage = readFileSync(join(meshes, "3d/limb_cage.obj"), "utf8").split("\n");
  const hole = join(work, "my_cage.obj");
  writeFileSync(hole, cage.filter((line, k) => k !== cage.findIndex((other) => other.startsWith("f "))).join("\n"));
  await app.drop([hole]);
  await app.tab.waitForSelector("#cageProblem:not([hidden])");
  assert.match(await app.text("cageProblem"), /my_cage.obj: /);
  assert.ok((await app.ask("selection")).length > 0);
  await app.shot("dark_defect");
  await app.tab.$eval("#repair", (button) => button.click());
  await app.shown();
  await app.tab.waitForFunction(() => document.getElementById("cageProblem").hidden);
  await app.shot("dark_repaired");
  await app.close();
}

// What people have in 2D.
async function testShapes() {
  const app = await new App().open(browser, url, { viewport: { width: 420, height: 800 } });
  await app.shot("narrow_start");
  const svg = join(work, "shape.svg");
  writeFileSync(svg, '<svg xmlns="http://www.w3.org/2000/svg"><path id="ell" d="M0 0 H90 V30 Q60 40 30 30 V80 H0 Z"/></svg>');
  await app.drop([svg]);
  await app.shown();
  await app.shot("narrow_svg");

  // It is saved as the same document: at rest with the same outline, in a pose with other numbers.
  const numbersOf = (file) => /<path id="ell" d="([^"]*)"/.exec(readFileSync(file, "utf8"))[1].match(/-?[\d.]+/g).map(Number);
  const atRest = numbersOf(await app.saved("[data-save=drawing]", "shape_posed.svg"));
  assert.ok(largestDifference(atRest, [0, 0, 90, 0, 90, 30, 70, 36.6667, 50, 36.6667, 30, 30, 30, 80, 0, 80]) < 0.01, String(atRest));
  rmSync(join(downloads, "shape_posed.svg"));
  await app.moveOne(30, 20);
  const inPose = numbersOf(await app.saved("[data-save=drawing]", "shape_posed.svg"));
  assert.ok(inPose.some((value, k) => Math.abs(value - atRest[k]) > 1), String(inPose));
  await app.tab.$eval("[data-do=home]", (button) => button.click());
  await app.tab.$eval("[data-do=draw]", (button) => button.click());
  const board = await (await app.tab.$("#sketch")).boundingBox();
  for (const [x, y] of [[0.1, 0.1], [0.9, 0.1], [0.9, 0.4], [0.4, 0.5], [0.4, 0.9], [0.1, 0.9]]) {
    await app.tab.mouse.click(board.x + x * board.width, board.y + y * board.height);
  }
  await app.shot("narrow_drawing");
  await app.tab.$eval("[data-do=finishDrawing]", (button) => button.click());
  await app.shown();
  await app.shot("narrow_drawn");

  // A picture of a disc, which the page itself paints.
  const data = await app.tab.evaluate(() => {
    const canvas = document.createElement("canvas");
    canvas.width = canvas.height = 120;
    const context = canvas.getContext("2d");
    for (const [color, radius] of [["#d33", 55], ["#fc3", 35], ["#36c", 15]]) {
      context.fillStyle = color;
      context.beginPath();
      context.arc(60, 60, radius, 0, 7);
      context.fill();
    }
    return canvas.toDataURL("image/png").split(",")[1];
  });
  const picture = join(work, "disc.png");
  writeFileSync(picture, Buffer.from(data, "base64"));
  await app.drop([picture]);
  await app.tab.waitForFunction(() => document.title.startsWith("disc"), { timeout: 60000 });
  await app.shown();
  await app.moveOne(30, 20);
  await app.shot("narrow_picture");

  // A drawing that a picture fills.
  await app.drop([svg, picture]);
  await app.tab.waitForFunction(() => document.title.startsWith("shape"), { timeout: 60000 });
  await app.shown();
  assert.equal(await app.tab.$eval("#coloring", (select) => select.value), "materials");
  await app.shot("narrow_filled");
  await app.close();
}

// Who has never heard of cages bends an elbow in five actions: a sample, a double-click, two keys,
// and a drag.
async function testElbow() {
  const app = await new App().open(browser, url);
  const { tab } = app;
  let actions = 0;
  const act = async (done) => { ++actions; await done; };
  await act(tab.click("[data-sample='character.obj']"));
  await app.shown();
  assert.equal(await tab.$eval("#coloring", (select) => select.value), "materials");
  const rest = await app.points();
  const near = (x) => rest.flatMap((_, k) => (k % 3 === 0 && Math.abs(rest[k] - x) < 0.1 && rest[k + 1] > 1.9 && rest[k + 1] < 3 ? [k] : []));
  const middle = (points, ks) => [0, 1, 2].map((c) => ks.reduce((sum, k) => sum + points[k + c], 0) / ks.length);
  const armOf = (points) => [[0.7, 1], [1.8, 2.2]].map(([from, to]) => {
    const [a, b] = [middle(points, near(from)), middle(points, near(to))];
    return b.map((value, c) => value - a[c]);
  });
  // What the eye finds: a control point at the elbow, and the one at the tip of the hand.
  const far = async (i) => Math.hypot(...(await app.ask("controlPoint", i)).map((value, c) => value - [1.45, 2.3, 0.25][c]));
  const elbow = await app.touchable(async (i) => await far(i) < 0.3);
  const { x, y } = await app.ask("spot", elbow);
  await act(tab.mouse.click(x, y, { count: 2 }));
  await app.shot("elbow_ring");
  await act(tab.keyboard.press("l"));
  await act(tab.keyboard.press("r"));
  const places = await Promise.all((await app.ask("selection")).map(async (i) => ({ i, place: await app.ask("controlPoint", i) })));
  const tip = places.reduce((a, b) => (b.place[0] > a.place[0] ? b : a)).i;
  await act(app.drag(await app.ask("spot", tip), -60, -120));
  const [upper, lower] = armOf(await app.points());
  const cosine = upper.reduce((sum, value, c) => sum + value * lower[c], 0) / Math.hypot(...upper) / Math.hypot(...lower);
  await app.shot("elbow_bent");
  const degrees = Math.acos(cosine) * 180 / Math.PI;
  console.log(`an elbow is bent by ${degrees.toFixed(0)} degrees in ${actions} actions`);
  assert.ok(degrees > 30 && actions <= 5);
  await app.close();
}

// Of a picture of the page: the share of its box that is to be seen, width by height, and the number of
// parts less that of holes, of which corners of pixels know (Gray 1971).
function shapeOfPicture(tab) {
  return tab.evaluate(async () => {
    const image = new Image();
    image.src = window.flbc.viewer.content.surface.pictures[0];
    await image.decode();
    const { width, height } = image;
    const canvas = Object.assign(document.createElement("canvas"), { width, height });
    const context = canvas.getContext("2d");
    context.drawImage(image, 0, 0);
    const { data } = context.getImageData(0, 0, width, height);
    const at = (x, y) => (x >= 0 && y >= 0 && x < width && y < height && data[4 * (x + width * y) + 3] > 16 ? 1 : 0);
    let [count, quarters] = [0, 0];
    for (let y = -1; y < height; ++y) {
      for (let x = -1; x < width; ++x) {
        const corners = [at(x, y), at(x + 1, y), at(x + 1, y + 1), at(x, y + 1)];
        const sum = corners.reduce((a, b) => a + b);
        count += corners[0];
        quarters += sum === 1 ? 1 : sum === 3 ? -1 : sum === 2 && corners[0] === corners[2] ? -2 : 0;
      }
    }
    return { share: count / (width * height), aspect: width / height, parts: quarters / 4 };
  });
}

// The same of the outline that the program takes from a drawing.
function shapeInProgram(file) {
  const outline = join(work, "outline.obj");
  execFileSync(program, ["convert", file, "-q", "-o", outline]);
  const places = vertices(outline, 2);
  const loops = readFileSync(outline, "utf8").split("\n").filter((line) => line.startsWith("l "))
    .map((line) => line.split(/\s+/).slice(1).map((i) => places.slice(2 * i - 2, 2 * i)));
  const areas = loops.map((loop) => loop.slice(1).reduce((sum, [x, y], k) => sum + (loop[k][0] * y - loop[k][1] * x) / 2, 0));
  const [width, height] = [0, 1].map((c) => { const all = places.filter((_, k) => k % 2 === c); return Math.max(...all) - Math.min(...all); });
  return { share: areas.reduce((a, b) => a + b) / (width * height), aspect: width / height,
           parts: areas.reduce((sum, area) => sum + Math.sign(area), 0) };
}

// A region is painted on one end of the limb; control points of the other end do not move it.
async function testProtecting() {
  const app = await new App().open(browser, url);
  const { tab } = app;
  const model = join(meshes, "3d/limb_model.obj");
  await app.drop([model]);
  await app.shown();
  const settled = () => tab.waitForFunction(() => !globalThis.flbcApp.protector.isBusy, { timeout: 60000 });
  const masks = () => tab.evaluate(() => globalThis.flbcApp.protector.masks());
  const xs = (points) => Array.from({ length: points.length / 3 }, (_, i) => points[3 * i]);
  const cage = xs(await tab.evaluate(() => [...window.flbc.viewer.editor.rest]));
  const low = Math.min(...cage), size = Math.max(...cage) - low;
  const chosen = cage.flatMap((x, i) => (x > low + 0.7 * size ? [i] : []));
  await app.ask("select", chosen);
  await app.unfold("protectSection");
  await app.press("paint");
  await settled();
  // The vertex of the other end that is nearest to the eye.
  const spot = await tab.evaluate((end) => {
    const { camera, canvas, deformer, content } = window.flbc.viewer;
    const box = canvas.getBoundingClientRect();
    let best = { nearness: -Infinity };
    for (let p = 0; p < deformer.points.length; p += 3) {
      const place = [0, 1, 2].map((k) => deformer.points[p + k] + content.center[k]);
      const seen = camera.project(place);
      if (place[0] < end && seen.nearness > best.nearness) best = seen;
    }
    return { x: box.left + best.x, y: box.top + best.y };
  }, low + 0.25 * size);
  const paint = async (dx, dy) => {
    await app.drag(spot, dx, dy);
    const begin = performance.now();
    await settled();
    return performance.now() - begin;
  };
  const duration = await paint(15, 10);
  const [mask, ...others] = await masks();
  assert.deepEqual(others, []);
  assert.deepEqual(mask.control_points, chosen);
  const { vertices: region } = mask.region;
  assert.ok(region.length > 5, `${region.length} vertices are painted`);
  console.log(`${region.length} vertices of ${(await app.points()).length / 3} are protected after ${duration.toFixed(0)} ms`);
  assert.match(await app.text("protected"), /does not move \d+ vert/);
  await app.shot("protect_painted");

  // Control points of the selection move everything else, and no vertex of the region by one bit.
  await app.press("paint");
  const rest = await app.points();
  const places = await Promise.all(chosen.map((i) => app.ask("controlPoint", i)));
  for (const [k, i] of chosen.entries()) await app.ask("move", i, places[k].map((x, c) => x + (c === 1 ? 0.3 * size : 0)));
  const moved = await app.points();
  for (const v of region) for (let c = 0; c < 3; ++c) assert.equal(moved[3 * v + c], rest[3 * v + c]);
  assert.ok(largestDifference(moved, rest) > 0.2 * size);
  await app.shot("protect_moved");
  await app.press("resetAll");

  // The program reads the saved file, and so does the page.
  const saved = await app.saved("#saveLocality", "limb_model_locality.json");
  const ownCage = await app.saved("[data-save=cage]", "limb_model_cage.obj");
  execFileSync(program, ["solve", ownCage, "--model", model, "--locality", saved, "--vertices", "1500", "-q", "-o", join(work, "protected.npy")]);
  await app.press("paint");
  await tab.keyboard.down("Control");
  await tab.keyboard.press("z");
  await tab.keyboard.up("Control");
  await settled();
  assert.deepEqual(await masks(), []);
  await (await tab.$("#localityFile")).uploadFile(saved);
  await tab.waitForFunction(() => globalThis.flbcApp.protector.masked.size > 0);
  await settled();
  assert.deepEqual(await masks(), [mask]);

  // What all control points must not move cannot stay: the page says where, and what to release.
  await app.ask("select", cage.map((_, i) => i));
  await paint(4, 0);
  assert.match(await app.text("protected"), /\d+ vert.* cannot stay: .*Release the ringed control points/);
  // They are drawn with the next frame.
  await tab.waitForFunction(() => document.querySelectorAll(".cure").length >= 4 && document.querySelector(".vertex"));
  await app.shot("protect_conflict");
  await app.press("release");
  await tab.waitForFunction(() => document.getElementById("release").hidden);
  await settled();
  assert.doesNotMatch(await app.text("protected"), /cannot/);
  assert.ok((await masks()).length > 0);
  await app.shot("protect_released");

  // The slider shows and sets the reach of the selection.
  await app.ask("select", [0]);
  await tab.$eval("#reach", (slider) => {
    slider.value = -2;
    for (const kind of ["input", "change"]) slider.dispatchEvent(new Event(kind));
  });
  assert.match(await app.text("reachFactor"), /0\.25/);
  await settled();
  const factors = await tab.evaluate(() => globalThis.flbcApp.protector.accepted.reach);
  assert.deepEqual(factors, [{ control_points: [0], factor: 0.25 }]);
  await app.ask("select", [1]);
  assert.match(await app.text("reachFactor"), /× 1$/);
  await app.shot("protect_reach");

  // Another worker, which a new model that is refused starts, knows the region.
  const bad = join(work, "bad.obj");
  writeFileSync(bad, "v 0 0 zero\n");
  await app.drop([bad]);
  await tab.waitForSelector("#problem:not([hidden])");
  const { accepted, starts } = await tab.evaluate(async () => {
    const { prepared, flbc, protector } = globalThis.flbcApp;
    await prepared;
    const { starts, controlPoints, values } = await flbc.weights();
    const isMoved = (v, i) => { for (let k = starts[v]; k < starts[v + 1]; ++k) if (controlPoints[k] === i && values[k] !== 0) return true; return false; };
    return { starts: starts.length, accepted: protector.accepted.masks.every(({ control_points: list, region }) =>
      list.every((i) => region.vertices.every((v) => !isMoved(v, i)))) };
  });
  assert.ok(accepted && starts > 1);

  // The start screen leads back. Regions and reach stay when an edge is split, and a timeline ends with its view.
  await app.press("back");
  await app.shown();
  await app.type("k");
  await app.press("play");
  const [kept, reached] = [await masks(), await tab.evaluate(() => globalThis.flbcApp.protector.factors())];
  const edge = await tab.evaluate(() => {
    globalThis.lastViewer = window.flbc.viewer;
    return [...window.flbc.viewer.content.edges.slice(0, 2)];
  });
  const click = (selector) => tab.$eval(selector, (button) => button.click());
  await app.ask("select", edge);
  await click("[data-do=split]");
  await tab.waitForFunction((size) => window.flbc.viewer.editor.size === size && globalThis.flbcApp.protector?.isUsed,
                            { timeout: 60000 }, cage.length + 1);
  await settled();
  assert.deepEqual(await masks(), kept);
  assert.deepEqual(await tab.evaluate(() => globalThis.flbcApp.protector.factors()), reached);
  assert.equal(await tab.evaluate(() => globalThis.lastViewer.playing), null);
  assert.equal(await tab.$eval("#timeline", (line) => line.hidden), true);

  // Weights of another problem are local ones.
  await app.unfold("compareSection");
  await app.press("harmonic");
  await tab.waitForFunction(() => document.getElementById("harmonic").getAttribute("aria-pressed") === "true");
  await app.ask("select", [2]);
  await tab.$eval("#reach", (slider) => {
    slider.value = -2;
    slider.dispatchEvent(new Event("change"));
  });
  await settled();
  await tab.waitForFunction(() => document.getElementById("local").getAttribute("aria-pressed") === "true");
  assert.ok(await tab.evaluate(() => {
    const { view: { deformer }, weights } = globalThis.flbcApp;
    return deformer.weights === weights.local;
  }));

  // What is cancelled at the last moment leaves everything as it was.
  await tab.evaluate(() => {
    const { flbc } = globalThis.flbcApp;
    flbc.content = async () => {
      delete flbc.content;
      throw Object.assign(new Error("cancelled"), { name: "Cancelled" });
    };
  });
  await app.ask("select", [edge[0], cage.length]);
  await click("[data-do=split]");
  await tab.waitForFunction(() => !Object.hasOwn(globalThis.flbcApp.flbc, "content"), { timeout: 60000 });
  await app.shown();
  assert.deepEqual(await masks(), kept);
  rmSync(join(downloads, "limb_model_weights.npy"), { force: true });
  const npy = readFileSync(await app.saved("[data-save=npy]", "limb_model_weights.npy"));
  assert.match(npy.toString("latin1", 0, 128), new RegExp(`, ${cage.length + 1}\\)`));
  await app.close();
}

// Icons with a black box behind them (g), of relative commands without a box (m), of strokes (s), of
// drawing programs with groups (i), and with styles (x): a cage around what is seen, with its picture.
async function testIcons() {
  const app = await new App().open(browser, url);
  const folder = join(here, "icons");
  for (const name of readdirSync(folder)) {
    const title = basename(name, ".svg");
    await app.drop([join(folder, name)]);
    await app.tab.waitForFunction((word) => document.title.startsWith(word) || !document.getElementById("problem").hidden, { timeout: 60000 }, title);
    assert.equal(await app.text("problem"), "", name);
    await app.shown();
    const seen = await app.tab.evaluate(() => {
      const { base, rest, surface } = window.flbc.viewer.content;
      const extents = [0, 1].map((c) => { const all = base.filter((_, k) => k % 3 === c); return Math.max(...all) - Math.min(...all); });
      return { controlPoints: rest.length / 3, pictures: surface.pictures.length, vertices: base.length / 3, extents };
    });
    assert.ok(seen.controlPoints >= 12 && seen.controlPoints < 80 && seen.vertices > 1000, `${name}: ${JSON.stringify(seen)}`);
    assert.equal(seen.pictures, 1, name);
    assert.ok(Math.max(...seen.extents) > 1000, `${name} does not fill its picture`);
    if (name.startsWith("g_")) assert.ok(seen.vertices < 7000, `${name}: the box behind it is a part`);
    const [painted, traced] = [await shapeOfPicture(app.tab), shapeInProgram(join(folder, name))];
    const both = `${name}: ${JSON.stringify([painted, traced])}`;
    for (const key of ["share", "aspect"]) assert.ok(Math.abs(traced[key] / painted[key] - 1) < 0.01, both);
    assert.equal(traced.parts, painted.parts, both);
  }
  await app.close();
}

// The document of a .glb.
function documentIn(file) {
  const bytes = readFileSync(file);
  return JSON.parse(bytes.subarray(20, 20 + bytes.readUInt32LE(12)));
}

// The corners of the box of all positions.
function boxOf({ accessors, meshes }) {
  const positions = meshes.flatMap(({ primitives }) => primitives.map(({ attributes }) => accessors[attributes.POSITION]));
  return ["min", "max"].flatMap((name) => [0, 1, 2].map((c) => Math[name](...positions.map((accessor) => accessor[name][c]))));
}

// A .glb comes back as it went in: materials, picture, and places, whatever is done to it. It has a
// long sword on the floor, so that its vertices alone do not say which axis points up.
async function testGltf() {
  const [vertices3d, faces] = ["v ", "f "].map((word) => readFileSync(join(meshes, "3d/character_model.obj"), "utf8")
    .split("\n").filter((line) => line.startsWith(word)));
  const part = (name, from, to) => [`usemtl ${name}`, ...faces.slice(from, to).map((line) => line.replace(/\d+/g, "$&/$&"))];
  const count = vertices3d.length, third = Math.floor(faces.length / 3);
  const sword = [[0, -0.4, 6], [0.2, -0.4, -8], [-0.2, -0.4, -8], [0, -0.2, -8]].map((place) => `v ${place.join(" ")}`);
  const texels = vertices3d.map((line) => `vt ${line.split(" ").slice(1, 3).map((x) => 0.15 * x + 0.4).join(" ")}`);
  writeFileSync(join(work, "knight.obj"), ["mtllib knight.mtl", ...vertices3d.map((line) => line.split(" ").slice(0, 4).join(" ")), ...sword,
    ...texels, "usemtl steel", ...[[1, 2, 3], [1, 3, 4], [1, 4, 2], [2, 4, 3]].map((face) => `f ${face.map((k) => k + count).join(" ")}`),
    ...part("cloth", 0, third), ...part("leather", third, 2 * third), ...part("badge", 2 * third)].join("\n"));
  writeFileSync(join(work, "knight.mtl"), "newmtl steel\nKd 0.6 0.6 0.7\nnewmtl cloth\nKd 0.8 0.1 0.1\nnewmtl leather\nKd 0.3 0.2 0.1\n"
    + "newmtl badge\nKd 1 1 1\nmap_Kd disc.png\n");
  const file = join(work, "knight.glb");
  execFileSync(program, ["convert", join(work, "knight.obj"), "-q", "-o", file]);
  const given = documentIn(file);
  const app = await new App().open(browser, url);
  await app.drop([file]);
  await app.shown();
  const { parts, up } = await app.tab.evaluate(() => ({ parts: window.flbc.viewer.content.surface.parts, up: window.flbc.viewer.content.up }));
  assert.equal(up, 1);
  assert.equal(parts.length, 4);
  assert.deepEqual(parts.filter(({ picture }) => picture === 0).length, 1);
  assert.equal(await app.tab.$eval("#coloring", (select) => select.value), "materials");
  await app.shot("knight");
  await app.type("k");
  await app.moveOne(40, -30);
  await app.type("k");
  await app.press("undo");
  for (const [button, name] of [["[data-save=posed]", "knight_posed.glb"], ["[data-save=glb4]", "knight.glb"],
                                ["[data-save=glb8]", "knight_8.glb"], ["#saveAnimation", "knight_animation.glb"]]) {
    const saved = documentIn(await app.saved(button, name));
    assert.deepEqual(saved.materials, given.materials, name);
    assert.equal(saved.images.length, 1, name);
    assert.deepEqual(boxOf({ ...saved, meshes: saved.meshes.slice(0, given.meshes.length) }), boxOf(given), name);
    assert.ok(!saved.nodes.some(({ rotation, matrix }) => rotation || matrix), `${name} is turned`);
    if (name.includes("animation")) assert.equal(saved.animations.length, 1);
  }
  await app.close();
}

// Files that decoding_test.mjs has compressed open as the others, and are saved without compression.
async function testCompressed() {
  const app = await new App().open(browser, url);
  for (const name of ["limb_draco", "limb_meshopt"]) {
    const file = join(work, `${name}.glb`);
    await app.drop([file]);
    await app.tab.waitForFunction((word) => document.title.startsWith(word) || !document.getElementById("problem").hidden, { timeout: 60000 }, name);
    assert.equal(await app.text("problem"), "", name);
    await app.shown();
    await app.shot(name);
    const saved = documentIn(await app.saved("[data-save=glb8]", `${name}_8.glb`)), given = documentIn(file);
    assert.deepEqual(saved.materials, given.materials);
    assert.equal(saved.extensionsRequired, undefined);
    boxOf({ ...saved, meshes: saved.meshes.slice(0, 1) }).forEach((x, k) => assert.ok(Math.abs(x - boxOf(given)[k]) < 1e-3, `${name}: another box`));
  }
  await app.close();
}

await testStart();
await testEarlyDrop(join(meshes, "3d/limb_model.obj"));
await testModel("Figure, in 2D", join(meshes, "2d/figure_model.obj"), 2);
await testModel("Limb", join(meshes, "3d/limb_model.obj"), 3);
await testElbow();
await testProtecting();
await testErrors();
await testShapes();
await testIcons();
await testGltf();
await testCompressed();
await browser.close();

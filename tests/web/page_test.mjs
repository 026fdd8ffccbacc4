// SPDX-License-Identifier: BSD-3-Clause
// flbc.html from its file, by real events: page_test.mjs BROWSER PAGE PROGRAM MESHES WORK
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { existsSync, mkdirSync, readdirSync, readFileSync, renameSync, rmSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { basename, join } from "node:path";
import { setTimeout as sleep } from "node:timers/promises";
import { fileURLToPath, pathToFileURL } from "node:url";
import { largestDifference, launch, Page, vertices } from "../browser/page.mjs";

const [executablePath, pagePath, program, meshes, work] = process.argv.slice(2);
const browser = await launch(executablePath);
const url = pathToFileURL(pagePath).href;
const axe = readFileSync(createRequire(new URL("../browser/page.mjs", import.meta.url)).resolve("axe-core/axe.min.js"), "utf8");
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

// What axe finds that hinders people with screen readers, keys alone, or weak eyes.
async function checkAccess(tab, place) {
  await tab.evaluate(axe);
  const found = await tab.evaluate(async () => (await globalThis.axe.run()).violations
    .map(({ id, help, nodes }) => `${id}: ${help}: ${nodes.map(({ html, any }) => `${html.slice(0, 120)} ${any.map(({ message }) => message)}`).join("; ")}`));
  assert.deepEqual(found, [], place);
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
  await app.press("resetAll");
  await app.type("k");
  const animated = await app.saved("#saveAnimation", `${title}_animation.glb`);
  assert.match(String(execFileSync(program, ["info", animated])), /animation of 2 s/);
  await app.shot(`${dim}d_keys`);
  for (let k = 0; k < 2; ++k) await app.press("removeKey");
  assert.equal(await app.tab.$eval("#timeline", (line) => line.hidden), true);
  for (let k = 0; k < 5; ++k) await app.press("undo");
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
  await checkAccess(app.tab, "start screen");

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
  const small = join(work, "small_cage.obj");
  writeFileSync(small, cage.map((line) => (line.startsWith("v ") ? `v ${line.split(" ").slice(1, 4).map((x) => 0.5 * x).join(" ")}` : line)).join("\n"));
  await app.drop([small]);
  await app.tab.waitForSelector("#cageProblem:not([hidden])", { timeout: 60000 });
  assert.match(await app.text("cageProblem"), /outside the cage/);
  assert.doesNotMatch(await app.text("cageProblem"), /kNearest|\(\)|--/);
  const hole = join(work, "my_cage.obj");
  writeFileSync(hole, cage.filter((line, k) => k !== cage.findIndex((other) => other.startsWith("f "))).join("\n"));
  await app.drop([hole]);
  await app.tab.waitForFunction(() => document.getElementById("cageProblem").textContent.includes("my_cage"), { timeout: 60000 });
  assert.match(await app.text("cageProblem"), /my_cage.obj: /);
  assert.ok((await app.ask("selection")).length > 0);
  await app.shot("dark_defect");
  await app.tab.$eval("#repair", (button) => button.click());
  await app.shown();
  await app.tab.waitForFunction(() => document.getElementById("cageProblem").hidden);
  await app.shot("dark_repaired");
  await app.unfold("protectSection");
  await checkAccess(app.tab, "dark");

  // What is for programs is left out of messages.
  for (const say of [() => {
    globalThis.flbcApp.flbc.cageFile = async () => { throw new Error("the cage is gone; run flbc cage --repair"); };
    document.querySelector("[data-save=cage]").click();
  }, () => globalThis.flbcApp.protector.tell("the cage is gone; choose kNearest")]) {
    await app.tab.$eval("#note", (note) => { note.textContent = ""; });
    await app.tab.evaluate(say);
    await app.tab.waitForFunction(() => document.getElementById("note").textContent !== "");
    assert.equal(await app.text("note"), "the cage is gone");
  }
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

  // Its animation plays as an image: after half a second it looks otherwise.
  await app.type("k");
  await app.moveOne(-30, 20);
  await app.type("k");
  const playing = readFileSync(await app.saved("[data-save=playing]", "shape_animated.svg"), "utf8");
  assert.equal(playing.match(/<image /g).length, 25);  // from rest to the first key, and to the second
  const looks = await app.tab.evaluate(async (source) => {
    const image = new Image();
    image.src = `data:image/svg+xml;utf8,${encodeURIComponent(source)}`;
    document.body.append(image);
    await image.decode();
    const canvas = Object.assign(document.createElement("canvas"), { width: 90, height: 80 });
    const context = canvas.getContext("2d", { willReadFrequently: true });
    const seen = new Set();
    for (let k = 0; k < 20; ++k) {
      await new Promise((done) => { setTimeout(done, 50); });
      context.clearRect(0, 0, 90, 80);
      context.drawImage(image, 0, 0, 90, 80);
      const { data } = context.getImageData(0, 0, 90, 80);
      if (data.some((value) => value > 0)) seen.add(String(data));
    }
    image.remove();
    return seen.size;
  }, playing);
  assert.ok(looks > 2, String(looks));
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
  // It is saved as a picture: the same at rest, and frames of an animation.
  const isSame = await app.tab.evaluate(async (bytes, saved) => {
    const [one, other] = await Promise.all([bytes, saved].map(async (text) => {
      const image = new Image();
      image.src = `data:image/png;base64,${text}`;
      await image.decode();
      const canvas = Object.assign(document.createElement("canvas"), { width: image.width, height: image.height });
      canvas.getContext("2d").drawImage(image, 0, 0);
      return String(canvas.getContext("2d").getImageData(0, 0, image.width, image.height).data);
    }));
    return one === other;
  }, data, readFileSync(await app.saved("[data-save=photo]", "disc_posed.png")).toString("base64"));
  assert.ok(isSame);
  await app.type("k");
  await app.moveOne(30, 20);
  await app.type("k");
  const frames = String(execFileSync("python3", ["-m", "zipfile", "-l", await app.saved("[data-save=frames]", "disc_frames.zip")]));
  for (const name of ["disc.png", "disc.json", "frame_0001.png", "frame_0013.png"]) assert.ok(frames.includes(name), frames);
  await app.shot("narrow_picture");

  // Other pictures that browsers read.
  for (const extension of ["webp", "gif"]) {
    writeFileSync(join(work, `ball_${extension}.${extension}`), Buffer.from(data, "base64"));
    await app.tab.$eval("[data-do=home]", (button) => button.click());
    await app.drop([join(work, `ball_${extension}.${extension}`)]);
    await app.tab.waitForFunction((word) => document.title.startsWith(`ball_${word}`) || !document.getElementById("problem").hidden, { timeout: 60000 }, extension);
    assert.equal(await app.text("problem"), "", extension);
    await app.shown();
  }

  // A drawing that a picture fills.
  await app.drop([svg, picture]);
  await app.tab.waitForFunction(() => document.title.startsWith("shape"), { timeout: 60000 });
  await app.shown();
  assert.equal(await app.tab.$eval("#coloring", (select) => select.value), "materials");
  await app.shot("narrow_filled");
  await app.close();
}

// Who has never heard of cages bends an elbow in four actions: a sample, a double-click, a key, and a
// drag of a ring.
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
  // What the eye finds: a control point at the elbow, and the ring that turns the arm up.
  const far = async (i) => Math.hypot(...(await app.ask("controlPoint", i)).map((value, c) => value - [1.45, 2.3, 0.25][c]));
  const elbow = await app.touchable(async (i) => await far(i) < 0.3);
  const { x, y } = await app.ask("spot", elbow);
  await act(tab.mouse.click(x, y, { count: 2 }));
  await app.shot("elbow_ring");
  await act(tab.keyboard.press("l"));
  await drawn(tab);
  const ring = await cornersOf(tab, ".ring.z polyline");
  const [from, to] = [ring[8], ring[24]].sort((a, b) => b.y - a.y);
  await act(app.drag(from, to.x - from.x, to.y - from.y));
  const [upper, lower] = armOf(await app.points());
  const cosine = upper.reduce((sum, value, c) => sum + value * lower[c], 0) / Math.hypot(...upper) / Math.hypot(...lower);
  await app.shot("elbow_bent");
  const degrees = Math.acos(cosine) * 180 / Math.PI;
  console.log(`an elbow is bent by ${degrees.toFixed(0)} degrees in ${actions} actions`);
  assert.ok(degrees > 30 && actions <= 4);
  await app.close();
}

// Edges of a cage in 2D become curves with handles, which are control points: they are dragged, undone, saved, and
// loaded as others.
async function testCurves() {
  const app = await new App().open(browser, url);
  const { tab } = app;
  const svg = join(work, "curved.svg");
  writeFileSync(svg, '<svg xmlns="http://www.w3.org/2000/svg"><path id="bar" d="M0 0 H160 V40 H0 Z" fill="#36c"/></svg>');
  await app.drop([svg]);
  await app.shown();
  await app.unfold("cageSection");
  const sizeOf = () => tab.evaluate(() => window.flbc.viewer.editor.size);
  const isOn = () => tab.$eval("#curves", (button) => button.getAttribute("aria-pressed"));
  const press = async (expected) => {
    await app.press("curves");
    await tab.waitForFunction((size) => window.flbc.viewer.editor.size === size && document.getElementById("app").hidden, { timeout: 60000 }, expected);
    await app.shown();
  };
  // A pose of the straight cage stays.
  const corners = await sizeOf(), count = 3 * corners;
  assert.equal(await isOn(), "false");
  await app.ask("move", 1, (await app.ask("controlPoint", 1)).map((value) => value + 9));
  const straight = await pointsOfCage(tab), bent = await app.points();
  await press(count);
  assert.equal(await isOn(), "true");
  const posed = await pointsOfCage(tab);
  assert.deepEqual(posed.slice(0, 3 * corners), straight);
  // Straight edges move the model nearly as before: there are other weights, of more control points.
  const size = Math.max(...straight) - Math.min(...straight);
  assert.ok(largestDifference(await app.points(), bent) < 0.02 * size);
  await app.press("resetAll");
  const curves = await tab.evaluate(() => window.flbc.viewer.content.curves);
  const rest = await pointsOfCage(tab), points = await app.points();
  const { least, most } = await tab.evaluate(() => {
    const { starts, values } = window.flbc.viewer.deformer.weights;
    const sums = Array.from({ length: starts.length - 1 }, (_, p) => values.slice(starts[p], starts[p + 1]).reduce((sum, value) => sum + value, 0));
    return { least: Math.min(...values), most: Math.max(...sums.map((sum) => Math.abs(sum - 1))) };
  });
  assert.ok(least >= 0 && most < 1e-5, `${least}, ${most}`);

  // A handle is dragged, and takes the opposite one along only where both are in line. Its curve is
  // drawn where Bezier says, and the drawing bends.
  await app.ask("select", []);
  const handle = await app.touchable((i) => i >= corners);
  const curve = curves.find((each) => each.includes(handle));
  const away = await tab.evaluate(([a, , , b]) => {
    const { editor: { rest: all, sphere }, camera } = window.flbc.viewer;
    const [x, y] = [0, 1].map((c) => (all[3 * a + c] + all[3 * b + c]) / 2 - sphere.center[c]);
    return [70 * x / Math.hypot(x, y), -70 * y / Math.hypot(x, y), camera.height];
  }, curve);
  const middleOf = () => tab.evaluate((list) => {
    const { editor, camera } = window.flbc.viewer;
    const place = [0, 1, 2].map((c) => list.reduce((sum, i, m) => sum + [1, 3, 3, 1][m] / 8 * editor.points[3 * i + c], 0));
    return camera.project(place);
  }, curve);
  const before = await app.picture();
  await app.drag(await app.ask("spot", handle), away[0], away[1]);
  const after = await pointsOfCage(tab);
  const hub = curve[1] === handle ? curve[0] : curve[3];
  const opposite = curves.flatMap(([a, first, second, b]) => [[a, first], [b, second]]).find(([i, own]) => i === hub && own !== handle)[1];
  const arms = (all) => [handle, opposite].map((i) => [0, 1].map((c) => all[3 * i + c] - all[3 * hub + c]));
  const sine = ([[ax, ay], [bx, by]]) => (ax * by - ay * bx) / Math.hypot(ax, ay) / Math.hypot(bx, by);
  const isInLine = Math.abs(sine(arms(rest))) < 1e-3;
  const others = Array.from({ length: count }, (_, i) => i).filter((i) => i !== handle && [0, 1].some((c) => after[3 * i + c] !== rest[3 * i + c]));
  assert.deepEqual(others, isInLine ? [opposite] : []);
  if (isInLine) assert.ok(Math.abs(sine(arms(after))) < 1e-9);
  assert.ok(largestDifference(after, rest) > 0);
  await app.shot("curve_bent");
  const moved = await app.points();
  assert.ok(largestDifference(moved, points) > 1e-3 * size, "the drawing does not bend");
  const middle = await middleOf();
  await tab.mouse.move(5, 5);
  const picture = await app.picture(), width = await tab.$eval("#canvas", (canvas) => canvas.clientWidth);
  const isDrawn = (pixels) => [-1, 0, 1].some((dx) => [-1, 0, 1].some((dy) => {
    const pixel = pixels[Math.round(middle.x) + dx + width * (Math.round(middle.y) + dy)];
    return (pixel & 255) < 120 && (pixel >> 16 & 255) < 120;
  }));
  assert.ok(!isDrawn(before) && isDrawn(picture), "the curve is elsewhere");
  await app.press("undo");
  assert.deepEqual(await pointsOfCage(tab), rest);
  assert.deepEqual(await app.points(), points);
  await app.press("redo");
  assert.deepEqual(await pointsOfCage(tab), after);

  // A corner takes its handles along.
  const corner = await app.touchable((i) => i < corners);
  const own = curves.flatMap(([a, first, second, b]) => [[a, first], [b, second]]).filter(([i]) => i === corner).map(([, i]) => i);
  await app.ask("select", [handle]);  // or the first drag takes a limb
  await app.drag(await app.ask("spot", corner), 24, 16);
  const taken = await pointsOfCage(tab);
  const step = (i) => [0, 1].map((c) => taken[3 * i + c] - after[3 * i + c]);
  for (let i = 0; i < count; ++i) {
    assert.ok(largestDifference(step(i), i === corner || own.includes(i) ? step(corner) : [0, 0]) < 1e-9 * size, `control point ${i}`);
  }
  assert.ok(Math.hypot(...step(corner)) > 0);
  await app.shot("curve_corner");

  // The drawing itself is dragged, by handles as well.
  const grip = await tab.evaluate(() => {
    const { camera, canvas } = window.flbc.viewer, { left, top } = canvas.getBoundingClientRect(), all = window.flbc.points();
    const spots = Array.from({ length: all.length / 2 }, (_, p) => camera.project([all[2 * p], all[2 * p + 1], 0]));
    const far = ({ x, y }) => Math.hypot(x - camera.width / 2, y - camera.height / 2);
    const p = spots.indexOf(spots.reduce((best, spot) => (far(spot) < far(best) ? spot : best)));
    return { p, x: left + spots[p].x, y: top + spots[p].y, pixel: camera.step([0, 0, 0], 1, 0)[0] };
  });
  await app.press("dragModel");
  const places = await app.points();
  await app.drag(grip, 30, -18);
  const followed = (await app.points()).slice(2 * grip.p, 2 * grip.p + 2).map((value, c) => (value - places[2 * grip.p + c]) / grip.pixel);
  assert.ok(Math.hypot(followed[0] - 30, followed[1] - 18) < 2, String(followed));
  assert.ok((await pointsOfCage(tab)).some((value, k) => value !== taken[k] && k >= 3 * corners));
  await app.press("undo");
  await app.press("dragModel");
  assert.deepEqual(await pointsOfCage(tab), taken);

  // What is saved does the same in the program, as a rig, as a drawing, and in a page of its own; a pose comes back.
  const pose = await app.saved("#savePose", "curved_pose.obj");
  const files = { weights: "curved_weights.npy", cage: "curved_cage.obj" };
  const weights = await app.saved("[data-save=npy]", files.weights), cage = await app.saved("[data-save=cage]", files.cage);
  const posedModel = await app.saved("[data-save=posed]", "curved_posed.obj");
  const shown = await app.points();
  assert.ok(largestDifference(vertices(posedModel, 2), shown) < 5e-3 * size);
  const model = join(work, "curved_model.obj"), out = join(work, "curved_out.obj");
  await app.press("resetAll");
  rmSync(posedModel);
  renameSync(await app.saved("[data-save=posed]", "curved_posed.obj"), model);
  execFileSync(program, ["deform", model, "--weights", weights, "--pose", pose, "--rest", cage, "-q", "-o", out]);
  assert.ok(largestDifference(vertices(out, 2), shown) < 5e-3 * size);
  const numbersOf = (file) => /<path id="bar" d="([^"]*)"/.exec(readFileSync(file, "utf8"))[1].match(/-?[\d.]+/g).map(Number);
  const atRest = numbersOf(await app.saved("[data-save=drawing]", "curved_posed.svg"));
  const [chooser] = await Promise.all([tab.waitForFileChooser(), app.press("loadPose")]);
  await chooser.accept([pose]);
  await tab.waitForFunction((x) => window.flbc.viewer.editor.points[x] !== window.flbc.viewer.editor.rest[x], {}, 3 * handle);
  assert.ok(largestDifference(await pointsOfCage(tab), taken) < 1e-9 * size);
  rmSync(join(downloads, "curved_posed.svg"));
  assert.notDeepEqual(numbersOf(await app.saved("[data-save=drawing]", "curved_posed.svg")), atRest);
  await app.type("k");
  const rig = await app.saved("[data-save=glb8]", "curved_8.glb");
  assert.match(String(execFileSync(program, ["info", rig])), new RegExp(`skin of ${count}|skin of ${count + 1}|skin of ${count + 2}`));
  const animated = await app.saved("#saveAnimation", "curved_animation.glb");
  assert.match(String(execFileSync(program, ["info", animated])), /animation of 1 s/);
  const page = await new Page().open(browser, pathToFileURL(await app.saved("[data-save=page]", "curved.html")).href);
  assert.deepEqual(await page.tab.evaluate(() => window.flbc.viewer.content.curves), curves);
  await page.picture(join(work, "curved_page.png"));
  await page.close();

  // The cage at rest is reshaped by a handle, regions are painted, and edges are split.
  await app.press("resetAll");
  await app.unfold("reshapeSection");
  await app.press("reshape");
  await app.ask("select", [handle]);
  await app.drag(await app.ask("spot", handle), 0.3 * away[0], 0.3 * away[1]);
  await tab.waitForFunction(() => !window.flbc.viewer.reshaper.isBusy, { timeout: 60000 });
  assert.ok(largestDifference(await app.points(), points) < 1e-5 * size);
  assert.equal(await app.text("note") === "" || !/refused|outside/.test(await app.text("note")), true);
  await app.press("reshape");
  const reshaped = await tab.evaluate(() => [...window.flbc.viewer.editor.rest]);
  assert.ok(largestDifference(reshaped, rest) > 0);
  await app.ask("select", [curve[0], curve[3]]);
  await tab.$eval("[data-do=split]", (button) => button.click());
  await tab.waitForFunction((expected) => window.flbc.viewer.editor.size === expected, { timeout: 60000 }, count + 3);
  await app.shown();
  assert.equal(await isOn(), "true");
  await app.unfold("cageSection");
  await app.ask("select", []);
  await app.moveOne(20, 12);
  await press(corners + 1);
  assert.equal(await isOn(), "false");
  assert.ok(largestDifference(await pointsOfCage(tab), await tab.evaluate(() => [...window.flbc.viewer.editor.rest])) > 0, "the pose is gone");
  await app.shot("curves_off");
  await app.close();
}

// A walk of four keys is made, edited, and saved as a rig and as a film in twenty actions.
async function testWalk() {
  const app = await new App().open(browser, url);
  const { tab } = app;
  let actions = 0;
  const act = async (done) => { ++actions; await done; };
  await act(tab.click("[data-sample='character.obj']"));
  await app.shown();
  const rest = await pointsOfCage(tab);
  const hip = async (side) => app.touchable(async (i) => {
    const [x, y] = await app.ask("controlPoint", i);
    return side * x > 0.1 && y > 0.15 && y < 0.6;
  });
  const swing = async (leg, dy) => {
    const { x, y } = await app.ask("spot", leg);
    await act(tab.mouse.click(x, y, { count: 2 }));
    await act(tab.keyboard.press("l"));
    await drawn(tab);
    const ring = await cornersOf(tab, ".ring.x polyline");
    await act(app.drag(ring[18], 0, dy));
    await act(tab.keyboard.press("k"));
  };
  const legs = [await hip(-1), await hip(1)];
  await swing(legs[0], 60);
  await act(app.press("resetAll"));
  await act(tab.keyboard.press("k"));
  await swing(legs[1], 60);
  await act(app.press("loop"));
  const poses = () => tab.evaluate(() => window.flbc.viewer.content.poses.map(({ time, points }) => ({ time, points: [...points] })));
  const made = await poses();
  assert.deepEqual(made.map(({ time }) => time), [0, 1, 2, 3, 4]);
  for (const k of [0, 2, 4]) assert.deepEqual(made[k].points, rest);
  for (const [k, leg] of [[1, legs[0]], [3, legs[1]]]) {
    const moved = rest.filter((x, c) => c % 3 === 0 && [c + 1, c + 2].some((d) => Math.abs(rest[d] - made[k].points[d]) > 0.01));
    assert.ok(moved.length > 5 && moved.reduce((sum, x) => sum + x) * rest[3 * leg] > 0, `key ${k} moves another leg`);
  }

  // The first step becomes longer, and all steps faster.
  const middleOf = async (k) => { const box = await (await tab.$$("#keyMarks span"))[k].boundingBox(); return { x: box.x + box.width / 2, y: box.y + box.height / 2 }; };
  const { x, y } = await middleOf(1);
  await act(tab.mouse.click(x, y));
  await drawn(tab);
  const ring = await cornersOf(tab, ".ring.x polyline");
  await act(app.drag(ring[18], 0, 25));
  await act(tab.keyboard.press("k"));
  const last = await middleOf(4), before = await middleOf(3);
  await act(app.drag(last, (before.x - last.x) / 2, 0));
  const edited = await poses();
  assert.deepEqual(edited.map(({ time }) => time), [0, 1, 2, 3, 3.5]);
  assert.notDeepEqual(edited[1].points, made[1].points);
  await app.shot("walk");
  await act(app.press("play"));
  await sleep(300);
  await app.shot("walk_plays");
  await act(app.press("play"));
  const inPose = await pointsOfCage(tab);
  await act(app.saved("#saveAnimation", "character_animation.glb"));
  assert.match(String(execFileSync(program, ["info", join(downloads, "character_animation.glb")])), /animation of 3.5 s/);
  await act(app.saved("#saveFilm", "character.webm"));
  console.log(`a walk of four keys is made, edited, and saved twice in ${actions} actions`);
  assert.ok(actions <= 20);
  assert.deepEqual(await pointsOfCage(tab), inPose);

  // The film has the size of the picture, and moves.
  const { width, height, looks } = await tab.evaluate(async (data) => {
    const video = Object.assign(document.createElement("video"), { muted: true, src: `data:video/webm;base64,${data}` });
    await new Promise((done, fail) => { video.onloadeddata = done; video.onerror = () => fail(video.error); });
    const context = Object.assign(document.createElement("canvas"), { width: 160, height: 120 }).getContext("2d", { willReadFrequently: true });
    const looks = new Set();
    video.playbackRate = 2;
    video.play();
    while (!video.ended) {
      await new Promise((done) => { setTimeout(done, 20); });
      context.drawImage(video, 0, 0, 160, 120);
      looks.add(String(context.getImageData(0, 0, 160, 120).data));
    }
    return { width: video.videoWidth, height: video.videoHeight, looks: looks.size };
  }, readFileSync(join(downloads, "character.webm")).toString("base64"));
  const size = await tab.$eval("#canvas", (canvas) => [canvas.width, canvas.height]);
  assert.deepEqual([width, height], size);
  assert.ok(looks > 2, `${looks} pictures`);
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
  assert.match(await app.text("protected"), /^Drag on the model to paint/);
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

  // A solid region of a file gets a joint in .glb files, if the box is checked.
  const load = async (path) => {
    await (await tab.$("#localityFile")).uploadFile(path);
    await tab.waitForFunction(() => globalThis.flbcApp.protector.isBusy);
    await settled();
  };
  const button = join(work, "button.json");
  writeFileSync(button, JSON.stringify({ solid: [{ region: { vertices: [0, 1, 2, 3, 4, 5, 6, 7] } }] }));
  const isOffered = () => tab.$eval("#rigidParts", (label) => !label.hidden);
  assert.ok(!await isOffered());
  await load(button);
  assert.ok(await isOffered());
  await tab.$eval("#rigid", (box) => box.click());
  assert.match(readFileSync(await app.saved("[data-save=glb4]", "limb_model.glb"), "latin1"), /"solid_0"/);
  await app.shot("protect_solid");
  await load(saved);
  assert.deepEqual(await masks(), [mask]);

  // What all control points must not move cannot stay: the page says where, and what to release.
  await app.ask("select", cage.map((_, i) => i));
  await paint(4, 0);
  assert.match(await app.text("protected"), /\d+ vert.* cannot stay: .*Release the ringed control points.* weights and reach stay as they were/);
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
  await app.press("resetAll");
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

// Pictures that browsers do not read are named.
async function testKtx() {
  const bytes = execFileSync(program, ["convert", join(meshes, "3d/limb_model.obj"), "-q", "-o", join(work, "limb_ktx.glb")])
    && readFileSync(join(work, "limb_ktx.glb"));
  const document = documentIn(join(work, "limb_ktx.glb"));
  const text = JSON.stringify({ ...document, extensionsUsed: ["KHR_texture_basisu"] }), rest = bytes.subarray(20 + bytes.readUInt32LE(12));
  const json = Buffer.from(text.padEnd(4 * Math.ceil(text.length / 4)));
  const header = Buffer.from(Uint32Array.of(0x46546C67, 2, 20 + json.length + rest.length, json.length, 0x4E4F534A).buffer);
  writeFileSync(join(work, "limb_ktx.glb"), Buffer.concat([header, json, rest]));
  const app = await new App().open(browser, url);
  await app.drop([join(work, "limb_ktx.glb")]);
  await app.shown();
  await app.tab.waitForFunction(() => /KTX2.* does not show/.test(document.getElementById("note").textContent));
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

// Where the corners of a handle of the gizmo are on the page.
function cornersOf(tab, selector) {
  return tab.$eval(`#gizmo ${selector}`, (shape) => {
    const box = shape.ownerSVGElement.getBoundingClientRect();
    return shape.getAttribute("points").split(" ").map((corner) => {
      const [x, y] = corner.split(",").map(Number);
      return { x: box.left + x, y: box.top + y };
    });
  });
}

const pointsOfCage = (tab) => tab.evaluate(() => [...window.flbc.viewer.editor.points]);
const drawn = (tab) => tab.evaluate(() => new Promise((done) => { requestAnimationFrame(() => requestAnimationFrame(done)); }));

// Handles at the selection move it along an axis, in a plane, and rotate it: by the pointer, by numbers, and in steps.
async function testGizmo() {
  const app = await new App().open(browser, url);
  const { tab } = app;
  const { mouse, keyboard } = tab;
  for (const [name, dim] of [["3d/limb", 3], ["2d/figure", 2]]) {
    await app.drop([join(meshes, `${name}_model.obj`)]);
    await tab.waitForFunction((title) => document.title.startsWith(title), { timeout: 120000 }, basename(name));
    await app.shown();
    assert.equal(await tab.$$eval("#gizmo g", (handles) => handles.length), 0);
    const canvas = await (await tab.$("#canvas")).boundingBox();
    await keyboard.down("Shift");
    await app.drag({ x: canvas.x + 2, y: canvas.y + 60 }, canvas.width / 2, canvas.height - 65);
    await keyboard.up("Shift");
    const chosen = await app.ask("selection"), rest = await pointsOfCage(tab), count = rest.length / 3;
    assert.ok(chosen.length > 1 && chosen.length < count);
    await drawn(tab);
    const counts = await tab.evaluate(() => ["arrow", "square", "ring", "center"].map((kind) => document.querySelectorAll(`#gizmo .${kind}`).length));
    assert.deepEqual(counts, dim === 3 ? [3, 3, 4, 1] : [2, 0, 1, 1]);
    await app.shot(`gizmo_${dim}d`);
    for (const i of chosen.slice(0, 3)) {
      const spot = await app.ask("spot", i);
      await mouse.move(spot.x, spot.y);
      assert.match(await app.state(), /^\d+ control points are selected/);
    }

    // The step that all selected control points make, and no other one.
    const stepOf = (points) => {
      const step = [0, 1, 2].map((c) => points[3 * chosen[0] + c] - rest[3 * chosen[0] + c]);
      for (let k = 0; k < 3 * count; ++k) {
        const expected = chosen.includes(Math.floor(k / 3)) ? step[k % 3] : 0;
        assert.ok(Math.abs(points[k] - rest[k] - expected) < 1e-9, `control point ${k / 3}`);
      }
      return step;
    };
    // Holds a handle, and drags it. \param end  what ends the drag
    const hold = async (from, dx, dy, end = async () => {}) => {
      await mouse.move(from.x, from.y);
      await mouse.down();
      await mouse.move(from.x + dx, from.y + dy, { steps: 5 });
      const text = await app.state();
      await end();
      await mouse.up();
      await drawn(tab);
      return text;
    };
    const undo = async () => {
      await app.press("undo");
      await drawn(tab);
      assert.deepEqual(await pointsOfCage(tab), rest);
    };

    // The tip of an arrow follows the pointer.
    for (const [axis, letter] of ["x", "y", "z"].slice(0, dim).entries()) {
      const [from, to] = await cornersOf(tab, `.arrow.${letter} polyline`);
      const far = Math.hypot(to.x - from.x, to.y - from.y);
      const said = await hold(to, 40 * (to.x - from.x) / far, 40 * (to.y - from.y) / far);
      const step = stepOf(await pointsOfCage(tab));
      assert.ok(step[axis] > 0 && step.every((x, c) => c === axis || x === 0), `${letter}: ${step}`);
      const [, now] = await cornersOf(tab, `.arrow.${letter} polyline`);
      assert.ok(Math.abs(Math.hypot(now.x - to.x, now.y - to.y) - 40) < (dim === 3 ? 8 : 1), "another way than the pointer");
      assert.match(said, new RegExp(`^move ${letter} `));
      assert.ok(Math.abs(Number(said.split(" ")[2]) / step[axis] - 1) < 0.01, `${said}: ${step}`);
      await undo();
    }
    if (dim === 3) {
      const [a, , c] = await cornersOf(tab, ".square.xy polygon");
      await hold({ x: (a.x + c.x) / 2, y: (a.y + c.y) / 2 }, 30, -25);
      const step = stepOf(await pointsOfCage(tab));
      assert.ok(step[0] !== 0 && step[1] !== 0 && step[2] === 0, `${step}`);
      await undo();
    }

    // A ring, by 30 degrees that are typed, and in steps with Ctrl.
    const middle = [0, 1].map((c) => chosen.reduce((sum, i) => sum + rest[3 * i + c], 0) / chosen.length);
    const armOf = (points, i) => [0, 1].map((c) => points[3 * i + c] - middle[c]);
    const anglesOf = (points) => chosen.map((i) => {
      const [[x, y], [u, v]] = [armOf(rest, i), armOf(points, i)];
      assert.ok(Math.abs(Math.hypot(u, v) - Math.hypot(x, y)) < 1e-9);
      assert.ok(Math.abs(points[3 * i + 2] - rest[3 * i + 2]) < 1e-9);
      return Math.hypot(x, y) < 1e-6 ? null : Math.atan2(x * v - y * u, x * u + y * v) * 180 / Math.PI;
    }).filter((angle) => angle !== null);
    const ring = `.ring.${dim === 3 ? "z" : "free"} polyline`;
    const turn = async (end) => {
      const { [13]: from, [20]: to } = await cornersOf(tab, ring);
      return hold(from, to.x - from.x, to.y - from.y, end);
    };
    await turn(async () => {
      await app.type("30");
      await app.shot(`gizmo_${dim}d_typed`);
      assert.match(await app.state(), /^rotate .*30°; press Enter/);
      await keyboard.press("Enter");
    });
    for (const angle of anglesOf(await pointsOfCage(tab))) assert.ok(Math.abs(angle - 30) < 1e-6, `${angle} degrees`);
    await undo();
    await keyboard.down("Control");
    const said = await turn();
    await keyboard.up("Control");
    const [steps, ...others] = anglesOf(await pointsOfCage(tab)).map((angle) => angle / 15);
    assert.ok(Math.abs(steps) > 0.5 && Math.abs(steps - Math.round(steps)) < 1e-6, `${15 * steps} degrees`);
    for (const other of others) assert.ok(Math.abs(other - steps) < 1e-6);
    assert.equal(said.replace(/^.* /, ""), `${15 * Math.round(steps)}°`);
    await undo();

    // Escape cancels, and a click on a handle changes nothing.
    await turn(() => keyboard.press("Escape"));
    assert.deepEqual(await pointsOfCage(tab), rest);
    const [grip] = await cornersOf(tab, ring);
    await mouse.click(grip.x, grip.y);
    assert.deepEqual(await pointsOfCage(tab), rest);

    // With a chosen axis there is one arrow.
    await app.type("y");
    await drawn(tab);
    assert.equal(await tab.$$eval("#gizmo .arrow", (arrows) => arrows.map((arrow) => arrow.classList[1]).join()), "y");
    await app.type("y");

    // With axes of the selection, arrows are those along which it extends.
    await app.type(",");
    await drawn(tab);
    const axes = await tab.evaluate(() => window.flbc.viewer.axes);
    const sum = (a, b) => chosen.reduce((total, i) => {
      const along = (axis) => [0, 1, 2].reduce((all, c) => all + axis[c] * (rest[3 * i + c] - mean[c]), 0);
      return total + along(a) * along(b);
    }, 0);
    const mean = [0, 1, 2].map((c) => chosen.reduce((total, i) => total + rest[3 * i + c], 0) / chosen.length);
    for (const [a, b] of ["xy", "yz", "zx"]) assert.ok(Math.abs(sum(axes[a], axes[b])) < 1e-9 * sum(axes.x, axes.x), `${a}${b}`);
    const letter = await tab.$eval("#gizmo .arrow", (arrow) => arrow.classList[1]);
    const [foot, tip] = await cornersOf(tab, `.arrow.${letter} polyline`);
    await hold(tip, (tip.x - foot.x) / 2, (tip.y - foot.y) / 2);
    const step = stepOf(await pointsOfCage(tab)), [u, v, w] = axes[letter];
    assert.ok(u * step[0] + v * step[1] + w * step[2] > 0);
    assert.ok(Math.hypot(v * step[2] - w * step[1], w * step[0] - u * step[2], u * step[1] - v * step[0]) < 1e-9);
    await app.shot(`gizmo_${dim}d_local`);
    await undo();
    await app.type(",");
  }
  await app.close();
}

// Keys are undone, inserted, moved, renamed, and removed.
async function testTimeline() {
  const app = await new App().open(browser, url);
  const { tab } = app;
  const { mouse, keyboard } = tab;
  await app.drop([join(meshes, "3d/limb_model.obj")]);
  await app.shown();
  const keys = () => tab.evaluate(() => window.flbc.viewer.content.poses.map(({ name, time, points }) => ({ name, time, points: [...points] })));
  const times = async () => (await keys()).map(({ time }) => time);
  const all = [await keys()], atRest = await pointsOfCage(tab);
  const keep = async () => { all.push(await keys()); };
  await app.moveOne(20, -15);
  await app.type("k");
  await keep();
  await app.moveOne(20, 15);
  await app.type("k");
  await keep();
  assert.deepEqual(await times(), [0, 1, 2]);
  assert.deepEqual((await keys())[2].points, await pointsOfCage(tab));
  await app.press("undo");
  assert.deepEqual(await keys(), all[1]);
  await app.press("redo");
  assert.deepEqual(await keys(), all[2]);

  // The key in the middle is dragged to a quarter.
  const marks = await tab.$$("#keyMarks span");
  assert.equal(marks.length, 3);
  const boxes = await Promise.all(marks.map((mark) => mark.boundingBox()));
  const [first, second] = boxes.map(({ x, y, width, height }) => ({ x: x + width / 2, y: y + height / 2 }));
  await app.drag(second, (first.x - second.x) / 2, 0);
  assert.deepEqual(await times(), [0, 0.5, 2]);
  assert.deepEqual((await keys())[1].points, all[2][1].points);
  await app.press("undo");
  assert.deepEqual(await keys(), all[2]);

  // The time and the name of the key that is chosen; its neighbors are no farther than it.
  const enter = async (id, text) => {
    await tab.click(`#${id}`, { count: 3 });
    await keyboard.type(text);
    await keyboard.press("Enter");
  };
  await mouse.click(second.x, second.y);
  await enter("keyTime", "1.4");
  await enter("keyName", "bow");
  assert.deepEqual((await keys()).map(({ name, time }) => [name, time]), [["rest", 0], ["bow", 1.4], ["key 2", 2]]);
  await enter("keyTime", "7");
  const [, { time: last }] = await keys();
  assert.ok(last > 1.9 && last < 2, `${last}`);
  await app.press("undo");
  await keep();

  // Between two keys another one is inserted, and at a key it is replaced.
  await tab.click("#canvas", { offset: { x: 5, y: 300 } });
  const track = await (await tab.$("#time")).boundingBox();
  await mouse.click(track.x + 8 + 0.35 * (track.width - 16), track.y + track.height / 2);
  await app.moveOne(15, 15);
  await app.type("k");
  const [, inserted] = await keys();
  assert.equal((await keys()).length, 4);
  assert.ok(Math.abs(inserted.time - 0.7) < 0.03, `${inserted.time}`);
  assert.deepEqual(inserted.points, await pointsOfCage(tab));
  await app.moveOne(15, 15);
  await app.type("k");
  assert.equal((await keys()).length, 4);
  assert.deepEqual((await keys())[1].points, await pointsOfCage(tab));
  await app.shot("timeline");
  await app.press("removeKey");
  assert.deepEqual((await keys()).map(({ name }) => name), ["rest", "bow", "key 2"]);
  const numKeysSaved = async () => {
    rmSync(join(downloads, "limb_model_animation.glb"), { force: true });
    const file = await app.saved("#saveAnimation", "limb_model_animation.glb");
    assert.match(String(execFileSync(program, ["info", file])), /animation of 2 s/);
    const { accessors, animations: [{ samplers: [{ input }] }] } = documentIn(file);
    return accessors[input].count;
  };
  assert.equal(await numKeysSaved(), 25);
  await app.press("smooth");
  assert.equal(await numKeysSaved(), 3);
  await app.press("undo");
  assert.equal(await numKeysSaved(), 25);

  // A loop ends with the first key again, also when another one is added, and when the first one changes.
  await app.press("loop");
  const ends = async () => {
    const all = await keys();
    assert.deepEqual(all.at(-1).points, all[0].points);
    return all.map(({ time }) => Number(time.toFixed(2)));
  };
  assert.deepEqual(await ends(), [0, 1.4, 2, 2.6]);
  await tab.focus("#time");
  await keyboard.press("End");
  await app.moveOne(15, 15);
  await app.type("k");
  assert.deepEqual(await ends(), [0, 1.4, 2, 2.6, 3.6]);
  await tab.focus("#time");
  await keyboard.press("Home");
  await app.moveOne(10, 15);
  await app.type("k");
  assert.deepEqual((await keys())[0].points, await pointsOfCage(tab));
  await ends();
  await app.shot("timeline_loop");
  await app.press("keepPose");
  for (const part of await tab.$$("details")) await part.evaluate((details) => { details.open = true; });
  await checkAccess(tab, "work screen");

  // A browser without a recorder says so.
  await tab.evaluate(() => { globalThis.kept = MediaRecorder; delete globalThis.MediaRecorder; });
  await app.press("saveFilm");
  assert.match(await app.text("note"), /does not record films/);
  await tab.evaluate(() => { globalThis.MediaRecorder = globalThis.kept; });

  // Undo leads back through all of it.
  const undoAll = async () => {
    for (let k = 0; k < 250 && !(await tab.$eval("#undo", (button) => button.disabled)); ++k) await tab.$eval("#undo", (button) => button.click());
    assert.deepEqual(await keys(), all[0]);
    assert.equal(await tab.$eval("#timeline", (line) => line.hidden), true);
  };
  await undoAll();
  assert.deepEqual(await pointsOfCage(tab), atRest);

  // And through 200 random actions.
  const rest = atRest.length / 3;
  let seed = 7;
  const random = (count) => { seed = (48271 * seed) % 2147483647; return seed % count; };
  const center = (box) => ({ x: box.x + box.width / 2, y: box.y + box.height / 2 });
  const dragSome = async (selector) => {
    const parts = [];
    for (const part of await tab.$$(selector)) if (await part.isVisible()) parts.push(part);
    const box = await parts[random(parts.length || 1)]?.boundingBox();
    if (box) await app.drag(center(box), random(80) - 40, random(60) - 30, 2);
  };
  const press = (id) => tab.$eval(`#${id}`, (button) => { if (button.checkVisibility()) button.click(); });
  const actions = [
    () => app.type("k"), () => app.type("k"), () => press("smooth"), () => press("loop"), () => press("removeKey"), () => app.type(","),
    () => app.type("xyzgrs"[random(6)]), () => app.type("elpom"[random(5)]), () => dragSome("#gizmo polyline"), () => dragSome("#gizmo polygon"), () => dragSome("#keyMarks span"),
    async () => { const { x, y } = await app.ask("spot", random(rest)); await mouse.click(x, y); },
    async () => app.drag(await app.ask("spot", random(rest)), random(60) - 30, random(60) - 30, 2),
    async () => { await app.type("r"); await app.type(String(random(90))); await keyboard.press("Enter"); },
    () => press("keepPose"), () => tab.$$eval("#library button", (buttons, k) => buttons[k % buttons.length]?.click(), random(9)), () => press("undo"), () => press("redo"), () => press("play"),
    async () => { if (await tab.$eval("#timeline", (line) => !line.hidden)) { await tab.focus("#time"); await keyboard.press(["Home", "End", "PageUp"][random(3)]); } },
  ];
  for (let k = 0; k < 200; ++k) await actions[random(actions.length)]();
  await app.shot("timeline_random");
  await keyboard.press("Escape");
  const numStrokes = await tab.evaluate(() => window.flbc.viewer.editor.done.length);
  assert.ok(numStrokes > 50 && numStrokes < 200, `${numStrokes} strokes`);
  await undoAll();
  assert.deepEqual(await pointsOfCage(tab), atRest);
  await app.close();
}

// The first drag of all, at a wrist, takes the hand with it.
async function testFirstDrag() {
  const app = await new App().open(browser, url);
  await app.tab.click("[data-sample='character.obj']");
  await app.shown();
  const before = await pointsOfCage(app.tab);
  const x = (i) => before[3 * i], tip = Math.max(...before.filter((_, k) => k % 3 === 0));
  const wrist = await app.touchable(async (i) => x(i) > 0.7 * tip && x(i) < 0.9 * tip);
  await app.drag(await app.ask("spot", wrist), 20, -40);
  const after = await pointsOfCage(app.tab), chosen = await app.ask("selection");
  const hand = [...Array(before.length / 3).keys()].filter((i) => x(i) > Math.max(x(wrist), 0.9 * tip));
  assert.ok(hand.length > 0);
  for (const i of hand) assert.ok(chosen.includes(i), `${i} stays behind`);
  for (const i of chosen) for (let c = 0; c < 3; ++c) {
    assert.ok(Math.abs(after[3 * i + c] - before[3 * i + c] - after[3 * wrist + c] + before[3 * wrist + c]) < 1e-9);
  }
  assert.ok(chosen.length < before.length / 6, `${chosen.length} control points`);
  await app.shot("first_drag");
  await app.close();
}

// By keys alone: what is hidden has no focus, arrows walk along the cage, Space selects.
async function testKeyboard() {
  const app = await new App().open(browser, url);
  const { tab } = app;
  const { keyboard } = tab;
  for (let k = 0; k < 6; ++k) {
    await keyboard.press("Tab");
    assert.ok(await tab.evaluate(() => document.activeElement.closest("#app") !== null), `the focus is in a hidden part after ${k + 1} steps`);
  }
  await app.drop([join(meshes, "3d/limb_model.obj")]);
  await app.shown();
  assert.equal(await tab.evaluate(() => document.activeElement.id), "canvas");
  const outline = () => tab.$eval("#canvas", (canvas) => getComputedStyle(canvas).outlineStyle);
  assert.equal(await outline(), "none");
  await keyboard.press("Tab");
  await keyboard.down("Shift");
  await keyboard.press("Tab");
  await keyboard.up("Shift");
  assert.equal(await outline(), "solid");
  await app.shot("keyboard_focus");
  const neighbors = await tab.evaluate(() => window.flbc.viewer.editor.graph.neighbors.map((list) => [...list]));
  await keyboard.press("ArrowRight");
  await keyboard.press("Space");
  const [first, ...none] = await app.ask("selection");
  assert.deepEqual(none, []);
  let here = first;
  for (const [key, sign, c] of [["ArrowRight", 1, "x"], ["ArrowLeft", -1, "x"], ["ArrowDown", 1, "y"]]) {
    const spot = await app.ask("spot", here);
    await keyboard.press(key);
    const next = Number(/^control point (\d+) moves/.exec(await app.state())[1]);
    if (next === here) continue;
    assert.ok(neighbors[here].includes(next), `${next} is no neighbor of ${here}`);
    assert.ok(sign * ((await app.ask("spot", next))[c] - spot[c]) > 0, `${key} leads elsewhere`);
    here = next;
  }
  assert.notEqual(here, first);
  assert.deepEqual(await app.ask("selection"), [first]);
  await keyboard.press("Space");
  assert.deepEqual(await app.ask("selection"), [first, here].sort((a, b) => a - b));
  const before = await pointsOfCage(tab);
  await keyboard.down("Shift");
  await keyboard.press("ArrowUp");
  await keyboard.up("Shift");
  const moved = (await pointsOfCage(tab)).flatMap((x, k) => (x !== before[k] ? [Math.floor(k / 3)] : []));
  assert.deepEqual([...new Set(moved)], [first, here].sort((a, b) => a - b));

  // The start screen hides the model again, and leads back to it.
  await tab.$eval("[data-do=home]", (button) => button.click());
  assert.ok(await tab.$eval("#panel", (panel) => panel.inert));
  await app.press("back");
  assert.equal(await tab.evaluate(() => document.activeElement.id), "canvas");
  await app.close();
}

// Points without triangles are drawn at once, and dragged as other models.
async function testCloud() {
  const app = await new App().open(browser, url);
  const { tab } = app;
  const points = Array.from({ length: 3000 }, (_, k) => {
    const z = 1 - (k + 0.5) / 1500, radius = Math.sqrt(1 - z * z);
    return `${radius * Math.cos(2.4 * k)} ${radius * Math.sin(2.4 * k)} ${2 * z}`;
  });
  const file = join(work, "cloud.ply");
  writeFileSync(file, ["ply", "format ascii 1.0", `element vertex ${points.length}`, "property float x", "property float y",
                       "property float z", "end_header", ...points, ""].join("\n"));
  await app.drop([file]);
  await tab.waitForFunction(() => !document.getElementById("preview").hidden, { timeout: 60000 });
  const { isBusy, numPixels } = await tab.$eval("#preview", (canvas) => ({
    isBusy: !document.getElementById("busy").hidden,
    numPixels: canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height).data.filter((x, k) => k % 4 === 3 && x > 0).length }));
  assert.ok(isBusy && numPixels > 3000, `${numPixels} pixels`);
  await app.shot("cloud_busy");
  // The cage is shown while its weights are solved, and turned.
  const pixels = () => tab.$eval("#preview", (canvas) => canvas.toDataURL());
  await tab.waitForFunction(() => /filling the cage|solving/i.test(document.getElementById("stages").textContent), { timeout: 60000, polling: 20 });
  const before = await pixels();
  const { x, y } = await tab.$eval("#preview", (canvas) => canvas.getBoundingClientRect().toJSON());
  await tab.mouse.move(x + 90, y + 90);
  await tab.mouse.down();
  await tab.mouse.move(x + 150, y + 100);
  await tab.mouse.up();
  assert.notEqual(await pixels(), before);
  await app.shot("cloud_cage");
  await app.shown();
  await app.moveOne(30, -20);
  await app.shot("cloud");
  await app.type("c");
  const picture = await app.picture();
  assert.ok(picture.filter((pixel) => pixel !== picture[0]).length > 3000, "the points are not drawn");
  await app.close();
}

async function testWithoutWebGl() {
  const tab = await browser.newPage();
  await tab.evaluateOnNewDocument(() => { HTMLCanvasElement.prototype.getContext = () => null; });
  await tab.goto(url);
  await tab.waitForFunction(() => globalThis.flbcApp);
  assert.match(await tab.$eval("#problem", (message) => message.textContent), /WebGL2/);
  assert.deepEqual(await tab.$$eval("#drop, #samples", (parts) => parts.map((part) => part.checkVisibility())), [false, false]);
  await tab.close();
}

// On a phone dots leave the model to be seen, and while it moves there are none.
async function testDots() {
  const app = await new App().open(browser, url, { viewport: { width: 390, height: 844, hasTouch: true, isMobile: true } });
  const { tab } = app;
  await tab.tap("[data-sample='character.obj']");
  await app.shown();
  const withDots = await app.picture(join(work, "phone_dots.png"));
  await tab.evaluate(() => {
    const { renderer } = window.flbc.viewer;
    globalThis.numDots = 0;
    renderer.drawDots = () => { globalThis.numDots += 1; };
    window.flbc.viewer.redraw();
  });
  const without = await app.picture();
  await tab.evaluate(() => window.flbc.viewer.set("showsCage", false));
  const model = await app.picture(join(work, "phone_model.png"));
  const isModel = (k) => model[k] !== model[0];
  const area = model.reduce((sum, _, k) => sum + isModel(k), 0);
  const covered = withDots.reduce((sum, pixel, k) => sum + (isModel(k) && pixel !== without[k]), 0) / area;
  console.log(`dots cover ${(100 * covered).toFixed(0)}% of the model on a phone`);
  assert.ok(covered > 0.01 && covered <= 0.06, `${covered}`);
  await tab.evaluate(() => window.flbc.viewer.set("showsCage", true));
  await app.type("kk");
  const numDots = await tab.evaluate(async () => {
    const frame = () => new Promise((done) => { requestAnimationFrame(() => requestAnimationFrame(done)); });
    const count = async () => { globalThis.numDots = 0; await frame(); return globalThis.numDots; };
    window.flbc.viewer.redraw();
    const still = await count();
    document.getElementById("play").click();
    await frame();
    return { still, playing: await count(), isPlaying: window.flbc.viewer.playing !== null };
  });
  assert.ok(numDots.still > 0 && numDots.isPlaying);
  assert.equal(numDots.playing, 0);
  await app.close();
}

await testStart();
await testEarlyDrop(join(meshes, "3d/limb_model.obj"));
await testModel("Figure, in 2D", join(meshes, "2d/figure_model.obj"), 2);
await testModel("Limb", join(meshes, "3d/limb_model.obj"), 3);
await testElbow();
await testCurves();
await testWalk();
await testGizmo();
await testTimeline();
await testFirstDrag();
await testKeyboard();
await testCloud();
await testWithoutWebGl();
await testDots();
await testProtecting();
await testErrors();
await testShapes();
await testIcons();
await testGltf();
await testKtx();
await testCompressed();
await browser.close();

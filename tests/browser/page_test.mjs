// SPDX-License-Identifier: BSD-3-Clause
// Pages of flbc view under a mouse: page_test.mjs BROWSER PROGRAM MESHES WORK
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { existsSync, mkdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { setTimeout as sleep } from "node:timers/promises";
import { largestDifference, launch, Page, sizeOf, vertices } from "./page.mjs";

const [executablePath, program, meshes, work] = process.argv.slice(2);
const downloads = join(work, "downloads");
const isChromium = !executablePath.includes("firefox");
const browser = await launch(executablePath);

async function open(name, { hash = "", ...options } = {}) {
  const page = await new Page().open(browser, `file://${work}/${name}.html${hash}`, options);
  if (isChromium) {
    rmSync(downloads, { recursive: true, force: true });
    mkdirSync(downloads);
    const session = await page.tab.createCDPSession();
    await session.send("Browser.setDownloadBehavior",
                       { behavior: "allow", downloadPath: downloads });
  }
  return page;
}

async function downloaded(name) {
  const path = join(downloads, name);
  for (let k = 0; k < 200 && !existsSync(path); ++k) await sleep(50);
  assert.ok(existsSync(path), `${name} was not saved`);
  await sleep(100);
  return path;
}

async function savedPose(page, name) {
  if (isChromium) {
    await page.press("savePose");
    return downloaded(`${name}_model_pose.obj`);
  }
  const path = join(work, `${name}_pose.obj`);
  writeFileSync(path, await page.ask("pose"));
  return path;
}

function countDifferent(a, b) {
  return a.reduce((count, pixel, k) => count + (pixel !== b[k]), 0);
}

// What flbc deform makes of the model in a pose.
function deformed(model, weights, pose, dim) {
  const output = join(work, "deformed.obj");
  execFileSync(program, ["deform", model, "--weights", weights, "--pose", pose, "-q", "-o", output]);
  return vertices(output, dim);
}

async function testDrag(name, dim, model, weights, cage) {
  const page = await open(name);
  const size = sizeOf(vertices(cage, dim), dim);
  const rest = await page.points();
  assert.ok(largestDifference(rest, vertices(model, dim)) <= 1e-6 * size, "at rest");
  const before = await page.picture(join(work, `${name}_rest.png`));
  assert.ok(new Set(before).size > 20, "the picture is blank");

  const i = await page.grabbable();
  await page.drag(await page.ask("spot", i), 60, -45);
  const moved = await page.points();
  assert.ok(largestDifference(moved, rest) > 1e-3 * size, "nothing moved");
  const after = await page.picture(join(work, `${name}_moved.png`));
  assert.ok(countDifferent(before, after) > 200, "the picture did not change");

  const pose = await savedPose(page, name);
  const untouched = readFileSync(cage, "utf8").split("\n").filter((line, k) =>
    line !== readFileSync(pose, "utf8").split("\n")[k]);
  assert.equal(untouched.length, 1, "one line differs from the cage's file");
  assert.ok(largestDifference(moved, deformed(model, weights, pose, dim)) <= 1e-6 * size,
            "flbc deform puts the model elsewhere");

  await page.press("undo");
  assert.deepEqual(await page.points(), rest);
  await page.press("redo");
  assert.deepEqual(await page.points(), moved);
  await page.tab.keyboard.press("Escape");
  await page.press("resetAll");
  assert.deepEqual(await page.points(), rest);
  await page.close();
}

// Selecting, the tools and the hook.
async function testSelection(name, dim, cage) {
  const page = await open(name);
  const { tab } = page;
  const rest = vertices(cage, dim);
  const n = rest.length / dim;
  const box = await (await tab.$("#canvas")).boundingBox();
  await tab.keyboard.down("Shift");
  await page.drag({ x: box.x + 3, y: box.y + 60 }, box.width / 2, box.height - 65);
  await tab.keyboard.up("Shift");
  const chosen = await page.ask("selection");
  const expected = [];
  for (let i = 0; i < n; ++i) {
    const spot = await page.ask("spot", i);
    if (spot.x <= box.x + 3 + box.width / 2 && spot.y >= box.y + 60) expected.push(i);
  }
  assert.deepEqual(chosen, expected);
  assert.ok(chosen.length > 1 && chosen.length < n);

  for (const [tool, axis] of [["rotate", null], ["scale", "x"], ["move", "y"]]) {
    await page.press(tool);
    if (axis) await page.type(axis);
    let grabbed = null;
    for (const i of chosen) {
      const spot = await page.ask("spot", i);
      await page.drag(spot, 30, 22);
      const now = await page.ask("controlPoint", i);
      if (!now.every((value, k) => value === rest[dim * i + k])) grabbed = i;
      if (grabbed !== null) break;
    }
    assert.notEqual(grabbed, null, `${tool} moves nothing`);
    for (let i = 0; i < n; ++i) {
      const now = await page.ask("controlPoint", i);
      const before = rest.slice(dim * i, dim * i + dim);
      if (!chosen.includes(i)) assert.deepEqual(now, before);
      if (tool === "move") assert.equal(now[0], before[0]);
      if (tool === "scale") assert.equal(now[1], before[1]);
    }
    assert.deepEqual(await page.ask("selection"), chosen);
    await page.press("undo");
    if (axis) await page.type(axis);
  }

  const i = chosen[0];
  const place = rest.slice(dim * i, dim * i + dim).map((value) => value + 0.125);
  await page.ask("move", i, place);
  assert.deepEqual(await page.ask("controlPoint", i), place);
  await page.ask("undo");
  assert.deepEqual(await page.ask("controlPoint", i), rest.slice(dim * i, dim * i + dim));
  await page.close();
}

const minus = (a, b) => a.map((value, k) => value - b[k]);

function middleOf(points, indices) {
  return points[0].map((_, k) => indices.reduce((sum, i) => sum + points[i][k], 0) / indices.length);
}

async function cageOf(page) {
  const points = [];
  for (let i = 0; i < await page.tab.evaluate(() => window.flbc.viewer.editor.size); ++i) {
    points.push(await page.ask("controlPoint", i));
  }
  return points;
}

// What a person does who has never seen the page: the first drag looks right, because it takes a ring
// and what lies beyond it.
async function testFirstDrag(name, weights) {
  const page = await open(name);
  const i = await page.touchable((k) => page.tab.evaluate((v) => {
    const { editor } = window.flbc.viewer;
    return editor.graph.ring(editor.rest, v).length > 1;
  }, k));
  const shown = await page.state();
  const [, ...lines] = readFileSync(weights, "utf8").split("\n").filter((line) => line && !line.startsWith("%"));
  const entries = lines.map((line) => line.split(/\s+/).map(Number));
  const moved = entries.filter(([, column, value]) => column === i + 1 && value > 1e-4).length;
  const total = Math.max(...entries.map(([row]) => row));
  const share = Number(/moves ([^%]*)% of the vertices/.exec(shown)[1]);
  assert.ok(Math.abs(share - 100 * moved / total) < 0.01 * share + 1e-6, `${shown}, not ${moved} of ${total}`);

  const before = await cageOf(page);
  await page.drag(await page.ask("spot", i), 40, -30);
  const ring = await page.ask("selection");
  assert.ok(ring.length > 1 && ring.includes(i), `${ring}`);
  const after = await cageOf(page);
  const step = minus(after[i], before[i]);
  assert.ok(Math.hypot(...step) > 0);
  after.forEach((place, k) => {
    const expected = ring.includes(k) ? step : step.map(() => 0);
    assert.ok(largestDifference(minus(place, before[k]), expected) < 1e-9 * sizeOf(before.flat(), before[0].length));
  });
  await page.picture(join(work, `${name}_first_drag.png`));

  // From now on every control point is on its own.
  await page.ask("select", []);
  const j = await page.touchable((k) => !ring.includes(k));
  await page.drag(await page.ask("spot", j), 10, 10);
  assert.deepEqual(await page.ask("selection"), [j]);
  await page.close();
}

// A limb bends by: double click, L, R, 60, Enter.
async function testBend(name, dim) {
  const page = await open(name);
  const { tab } = page;
  const n = (await cageOf(page)).length;
  const limbOf = async (i) => {
    const spot = await page.ask("spot", i);
    await tab.mouse.click(spot.x, spot.y, { count: 2 });
    const ring = await page.ask("selection");
    await page.type("l");
    return [ring, await page.ask("selection")];
  };
  const i = await page.touchable(async (k) => {
    const [ring, limb] = await limbOf(k);
    return ring.length > 1 && limb.length > ring.length && limb.length < n / 2;
  });
  const [ring, limb] = await limbOf(i);
  assert.ok(ring.every((k) => limb.includes(k)));
  await page.type("+");
  assert.ok((await page.ask("selection")).length > limb.length);
  await page.type("-");
  assert.deepEqual(await page.ask("selection"), limb);
  await limbOf(i);

  const before = await cageOf(page);
  const center = middleOf(before, ring);
  await page.type("r60");
  assert.match(await page.state(), /rotate 60°/);
  await tab.keyboard.press("Enter");
  const after = await cageOf(page);
  const toward = await tab.evaluate(() => window.flbc.viewer.camera.axes().toward);
  const across = (arm) => {
    const along = arm.reduce((sum, value, k) => sum + value * toward[k], 0);
    return arm.map((value, k) => value - along * toward[k]);
  };
  const size = sizeOf(before.flat(), dim);
  for (let k = 0; k < n; ++k) {
    if (!limb.includes(k)) {
      assert.deepEqual(after[k], before[k]);
      continue;
    }
    const [a, b] = [before, after].map((places) => across(minus(places[k], center)));
    const cosine = a.reduce((sum, value, c) => sum + value * b[c], 0) / (Math.hypot(...a) * Math.hypot(...b));
    assert.ok(Math.abs(cosine - 0.5) < 1e-9);
    assert.ok(Math.abs(Math.hypot(...minus(after[k], center)) - Math.hypot(...minus(before[k], center))) < 1e-9 * size);
  }
  await page.picture(join(work, `${name}_bent.png`));
  await page.press("undo");
  assert.deepEqual(await cageOf(page), before);
  await page.type("r60");
  await tab.keyboard.press("Escape");
  assert.deepEqual(await cageOf(page), before, "Escape cancels");

  // A number during a drag, of which only one coordinate changes.
  await page.type("xg");
  const spot = await page.ask("spot", i);
  await tab.mouse.move(spot.x, spot.y);
  await tab.mouse.down();
  await tab.mouse.move(spot.x + 30, spot.y + 10, { steps: 3 });
  await page.type("-.25");
  await tab.mouse.move(spot.x + 50, spot.y + 10);
  await tab.keyboard.press("Enter");
  await tab.mouse.up();
  const moved = await cageOf(page);
  for (let k = 0; k < n; ++k) {
    const expected = before[k].map((value, c) => (c === 0 && limb.includes(k) ? value - 0.25 : value));
    assert.ok(largestDifference(moved[k], expected) < 1e-12 * size);
  }
  await page.close();
}

// Where the model is seen at a spot of the page: three vertices with their shares, found by the camera and not by
// the code that picks; null where there is none.
function seenAt(page, spot) {
  return page.tab.evaluate(({ x, y }) => {
    const { canvas, camera, content: { center, dim, surface: { triangles, sources } } } = window.flbc.viewer;
    const box = canvas.getBoundingClientRect(), points = window.flbc.points();
    const corners = Array.from({ length: points.length / dim }, (_, p) => {
      const place = [0, 1, 2].map((k) => (k < dim ? points[dim * p + k] : center[k]));
      const seen = camera.project(place);
      return { p, x: seen.x + box.left - x, y: seen.y + box.top - y, nearness: seen.nearness, far: camera.depthFactor(place) };
    });
    let found = null, nearest = -Infinity;
    for (let t = 0; t < triangles.length; t += 3) {
      const three = [0, 1, 2].map((k) => corners[sources ? sources[triangles[t + k]] : triangles[t + k]]);
      const areas = three.map((_, k) => {
        const [a, b] = [three[(k + 1) % 3], three[(k + 2) % 3]];
        return a.x * b.y - a.y * b.x;
      });
      const total = areas[0] + areas[1] + areas[2];
      if (areas.some((area) => area * total <= 0)) continue;
      const parts = areas.map((area, k) => area / total * three[k].far), sum = parts[0] + parts[1] + parts[2];
      const nearness = three.reduce((mean, corner, k) => mean + parts[k] / sum * corner.nearness, 0);
      if (nearness > nearest) [found, nearest] = [three.map(({ p }, k) => [p, parts[k] / sum]), nearness];
    }
    return found;
  }, spot);
}

// The model is grabbed itself: the place under the pointer stays there, by the control points with weights.
async function testDragModel(name, dim, weights) {
  const page = await open(name);
  const { tab } = page;
  const [, ...lines] = readFileSync(weights, "utf8").split("\n").filter((line) => line && !line.startsWith("%"));
  const owners = new Map();
  for (const [row, column, value] of lines.map((line) => line.split(/\s+/).map(Number))) {
    if (value !== 0) owners.set(row - 1, [...owners.get(row - 1) ?? [], column - 1]);
  }
  const spotOf = (shares) => tab.evaluate((list, d) => {
    const points = window.flbc.points(), { canvas, camera, content } = window.flbc.viewer;
    const place = [0, 1, 2].map((k) => (k < d ? list.reduce((sum, [p, share]) => sum + share * points[d * p + k], 0) : content.center[k]));
    const box = canvas.getBoundingClientRect(), { x, y } = camera.project(place);
    return { x: x + box.left, y: y + box.top };
  }, shares, dim);
  const isPressed = () => tab.$eval("#dragModel", (button) => button.getAttribute("aria-pressed"));
  const view = () => tab.evaluate(() => JSON.stringify(window.flbc.viewer.camera));
  const box = await (await tab.$("#canvas")).boundingBox();
  await page.press("dragModel");
  assert.equal(await isPressed(), "true");
  assert.match(await page.state(), /^drag the model/);
  const still = await view();
  for (const axis of [-1, 0]) {
    if (axis >= 0) await tab.select("#mirror", String(axis));
    const pairs = await tab.evaluate(() => window.flbc.viewer.editor.pairs);
    let count = 0;
    for (let k = 0; k < 40 && count < 2; ++k) {
      const spot = { x: Math.round(box.x + box.width * (0.1 + 0.8 * (k * 0.618 % 1))), y: Math.round(box.y + box.height * (0.1 + 0.8 * (k * 0.382 % 1))) };
      const shares = await seenAt(page, spot);
      if (!shares) continue;
      const holders = new Set(shares.flatMap(([p]) => owners.get(p)));
      if (pairs && [...holders].some((i) => holders.has(pairs[i]))) continue;  // near the plane, which it must not leave
      const before = await cageOf(page), points = await page.points();
      await page.drag(spot, 41, -32);
      const after = await cageOf(page), now = await spotOf(shares);
      assert.ok(Math.hypot(now.x - spot.x - 41, now.y - spot.y + 32) < 1.5, `${now.x}, ${now.y} instead of ${spot.x + 41}, ${spot.y - 32}`);
      const moved = after.flatMap((place, i) => (place.some((value, c) => value !== before[i][c]) ? [i] : []));
      assert.ok(moved.length > 0 && moved.length < before.length);
      for (const i of moved) assert.ok(holders.has(i) || holders.has(pairs?.[i]), `${i} has no weight there`);
      for (const i of pairs ? moved : []) {
        if (pairs[i] < 0) continue;
        const [a, b] = [i, pairs[i]].map((each) => minus(after[each], before[each]));
        assert.ok(largestDifference(a, b.map((value, c) => (c === axis ? -value : value))) < 1e-9);
      }
      if (count === 0) await page.picture(join(work, `${name}_model_dragged${axis}.png`));
      await page.press("undo");
      assert.deepEqual(await cageOf(page), before);
      assert.deepEqual(await page.points(), points);
      assert.equal(await tab.$eval("#undo", (button) => button.disabled), true, "one stroke");
      count += 1;
    }
    assert.equal(count, 2, `mirror ${axis}`);
  }
  assert.equal(await view(), still);

  // Next to the model the view moves, and without the switch control points are dragged.
  const rest = await cageOf(page);
  await page.drag({ x: box.x + 5, y: box.y + box.height - 5 }, 40, -20);
  assert.notEqual(await view(), still);
  await page.type("m");
  assert.equal(await isPressed(), "false");
  assert.deepEqual(await cageOf(page), rest);
  const i = await page.touchable();
  await page.drag(await page.ask("spot", i), 10, 10);
  assert.notDeepEqual(await page.ask("controlPoint", i), rest[i]);
  await page.close();
}

// Around a control point by Alt and click. Dragging elsewhere turns the view, whatever the tool.
async function testPivot(name, dim) {
  const page = await open(name);
  const { tab } = page;
  const pivot = await page.touchable();
  const chosen = await page.touchable((k) => k !== pivot);
  for (const [i, key] of [[chosen, null], [pivot, "Alt"]]) {
    const spot = await page.ask("spot", i);
    if (key) await tab.keyboard.down(key);
    await tab.mouse.click(spot.x, spot.y);
    if (key) await tab.keyboard.up(key);
  }
  assert.deepEqual(await page.ask("selection"), [chosen]);
  await tab.waitForSelector("#pivot", { visible: true });
  const before = await cageOf(page);
  await page.type("s2");
  await tab.keyboard.press("Enter");
  const after = await cageOf(page);
  const arm = minus(before[chosen], before[pivot]);
  assert.ok(largestDifference(minus(after[chosen], before[pivot]), arm.map((x) => 2 * x)) < 1e-9 * Math.hypot(...arm));
  const view = () => tab.evaluate(() => JSON.stringify(window.flbc.viewer.camera));
  const seen = await view();
  const box = await (await tab.$("#canvas")).boundingBox();
  await page.drag({ x: box.x + 5, y: box.y + box.height - 5 }, 40, -20);
  assert.notEqual(await view(), seen);
  assert.deepEqual(await cageOf(page), after);
  assert.deepEqual(await page.ask("selection"), [chosen]);
  await page.picture(join(work, `${name}_pivot.png`));
  await page.close();
}

// Neighbors follow, in part, and what lies in a lasso is selected.
async function testSoftAndLasso(name) {
  const page = await open(name);
  const { tab } = page;
  const i = await page.touchable();
  const spot = await page.ask("spot", i);
  await tab.mouse.click(spot.x, spot.y);
  await page.type("o");
  const before = await cageOf(page);
  await page.drag(spot, 50, -40);
  await page.picture(join(work, `${name}_soft.png`));
  const after = await cageOf(page);
  const far = (k) => Math.hypot(...minus(after[k], before[k]));
  const parts = before.map((_, k) => far(k) / far(i));
  assert.ok(parts.every((part) => part <= 1 + 1e-9));
  assert.ok(parts.some((part) => part > 0.05 && part < 0.95), "no neighbor follows");
  await page.press("undo");
  await page.type("o");
  await page.drag(spot, 50, -40);
  const alone = await cageOf(page);
  assert.equal(alone.filter((place, k) => place.some((x, c) => x !== before[k][c])).length, 1);

  const spots = [];
  for (let k = 0; k < before.length; ++k) spots.push(await page.ask("spot", k));
  const box = await (await tab.$("#canvas")).boundingBox();
  const [left, bottom] = [box.x + 2, box.y + box.height - 2];
  const [width, height] = [0.6 * box.width, 0.6 * box.height];
  await tab.keyboard.down("Control");
  await tab.mouse.move(left, bottom);
  await tab.mouse.down();
  await tab.mouse.move(left + width, bottom);
  await tab.mouse.move(left, bottom - height);
  await page.picture(join(work, `${name}_lasso.png`));
  await tab.mouse.up();
  await tab.keyboard.up("Control");
  const inside = spots.flatMap(({ x, y }, k) =>
    (x > left && y < bottom && (x - left) / width + (bottom - y) / height < 1 ? [k] : []));
  assert.deepEqual(await page.ask("selection"), [...new Set([i, ...inside])].sort((a, b) => a - b));
  await page.close();
}

// Poses survive a reload, are loaded from files, and become keys of an animation.
async function testKeptPoses(name, dim, pose) {
  const page = await open(name);
  const { tab } = page;
  const rest = await cageOf(page);
  const load = async (path) => {
    const [chooser] = await Promise.all([tab.waitForFileChooser(), page.press("loadPose")]);
    await chooser.accept([path]);
  };
  const wrong = join(work, "wrong_pose.obj");
  writeFileSync(wrong, "v 1 2 3\n");
  await load(wrong);
  await tab.waitForFunction(() => document.getElementById("note").textContent.includes("has 1 vertices"));
  await load(pose);
  await tab.waitForFunction(() => window.flbc.viewer.editor.canUndo);
  const posed = await cageOf(page);
  assert.deepEqual(posed.flat(), vertices(pose, dim));
  await page.press("keepPose");
  await tab.reload();
  await page.loaded();
  assert.deepEqual(await cageOf(page), posed);
  await tab.keyboard.down("Control");
  await page.type("z");
  await tab.keyboard.up("Control");
  assert.deepEqual(await cageOf(page), rest);
  await tab.reload();
  await page.loaded();
  assert.deepEqual(await cageOf(page), rest);
  assert.equal(await tab.$eval("#undo", (button) => button.disabled), true);

  // A pose with its picture is there as well: for all control points, and for those that are selected.
  const count = () => tab.$$eval("#library img", (pictures) => pictures.filter(({ naturalWidth }) => naturalWidth === 96).length);
  assert.equal(await count(), 1);
  const take = async () => { await tab.click("#library button"); return cageOf(page); };
  assert.ok(largestDifference((await take()).flat(), posed.flat()) < 1e-12 * sizeOf(posed.flat(), dim));
  await tab.screenshot({ path: join(work, `${name}_library.png`) });
  await page.press("undo");
  assert.deepEqual(await cageOf(page), rest);
  const moved = posed.findIndex((place, i) => largestDifference(place, rest[i]) > 0);
  await page.ask("select", [moved]);
  await tab.keyboard.down("Shift");
  const part = await take();
  await tab.keyboard.up("Shift");
  part.forEach((place, i) => assert.ok(largestDifference(place, (i === moved ? posed : rest)[i]) < 1e-9));
  await page.press("undo");

  // It goes to a file and comes back.
  await page.press("savePoses");
  const file = await downloaded(`${name}_model_poses.json`);
  await tab.click("#library button + button");
  assert.equal(await count(), 0);
  // Undone and redone as all else, and kept so.
  for (const [key, left] of [["z", 1], ["y", 0]]) {
    await tab.keyboard.down("Control");
    await page.type(key);
    await tab.keyboard.up("Control");
    await tab.waitForFunction((number) => document.querySelectorAll("#library img").length === number, {}, left);
    assert.equal(await tab.evaluate((ending) => JSON.parse(localStorage.getItem(
      Object.keys(localStorage).find((item) => item.endsWith(ending)))).length, " poses"), left);
  }
  writeFileSync(join(work, "other_poses.json"), JSON.stringify({ poses: [{ name: "a", picture: "data:image/png;,", steps: [1, 2, 3] }] }));
  await load(join(work, "other_poses.json"));
  await tab.waitForFunction(() => document.getElementById("note").textContent.includes("of a cage of 1 control point"));
  writeFileSync(join(work, "broken_poses.json"), '{ "poses": [null');
  await load(join(work, "broken_poses.json"));
  await tab.waitForFunction(() => document.getElementById("note").textContent.includes("not a file of saved poses"));
  assert.equal(await count(), 0);
  await load(file);
  await tab.waitForSelector("#library img");
  assert.ok(largestDifference((await take()).flat(), posed.flat()) < 1e-12 * sizeOf(posed.flat(), dim));
  await page.close();
}

// Where a file puts the vertices of its only mesh at each key, if nothing is rotated.
function keysIn(bytes, dim) {
  const length = bytes.readUInt32LE(12);
  const json = JSON.parse(bytes.subarray(20, 20 + length));
  const floatsOf = (index) => {
    const { byteOffset, byteLength } = json.bufferViews[json.accessors[index].bufferView];
    return new Float32Array(Uint8Array.from(bytes.subarray(28 + length).subarray(byteOffset, byteOffset + byteLength)).buffer);
  };
  const [{ attributes, targets }] = json.meshes[0].primitives;
  const { input, output } = json.animations[0].samplers[0];
  const base = floatsOf(attributes.POSITION), moved = targets.map(({ POSITION }) => floatsOf(POSITION));
  return [...floatsOf(input)].map((time, key) => ({ time, points: Array.from(base, (value, k) =>
    moved.reduce((sum, target, t) => sum + floatsOf(output)[key * moved.length + t] * target[k],
                 value + json.nodes[1].translation[k % 3])).filter((_, k) => k % 3 < dim) }));
}

// From a page without poses.
async function testKeys(name, dim, pose) {
  const page = await open(`${name}_rest`);
  const { tab } = page;
  const rest = await cageOf(page);
  const isShown = () => tab.$eval("#timeline", (element) => element.checkVisibility());
  assert.ok(!(await isShown()));
  const [chooser] = await Promise.all([tab.waitForFileChooser(), page.press("loadPose")]);
  await chooser.accept([pose]);
  await tab.waitForFunction(() => window.flbc.viewer.editor.canUndo);
  await page.type("k");
  const moved = await page.points();
  await page.press("resetAll");
  await page.type("k");
  assert.ok(await isShown());
  await page.press("saveAnimation");
  const file = await downloaded(`${name}_model_animation.glb`);
  assert.match(String(execFileSync(program, ["info", file])), /animation of 2 s/);
  const points = await page.points(), size = sizeOf(points, dim);
  const keys = keysIn(readFileSync(file), dim);
  assert.equal(keys.length, 25);
  keys.filter(({ time }) => Number.isInteger(time)).forEach((key, k) => {
    assert.equal(key.time, k);
    assert.ok(largestDifference(key.points, k === 1 ? moved : points) < 1e-6 * size, `key ${k}`);
  });
  await tab.reload();
  await page.loaded();
  assert.ok(await isShown(), "keys are kept");
  await tab.focus("#time");
  await tab.keyboard.press("Home");
  assert.deepEqual(await cageOf(page), rest);
  await tab.evaluate(() => { window.largest = 0; });
  await page.press("play");
  await tab.waitForFunction((x) => {
    window.largest = Math.max(window.largest, Math.abs(window.flbc.viewer.time - 1) < 0.1 ? 1 : 0);
    return window.largest > 0;
  });
  await page.press("play");
  await page.picture(join(work, `${name}_keys.png`));
  for (let k = 0; k < 2; ++k) await page.press("removeKey");
  assert.ok(!(await isShown()));
  await page.close();
}

async function testPoses(name, dim, model, weights, pose) {
  const page = await open(name);
  const size = sizeOf(vertices(pose, dim), dim);
  await page.tab.focus("#time");
  await page.tab.keyboard.press("End");
  const moved = await page.points();
  assert.ok(largestDifference(moved, deformed(model, weights, pose, dim)) <= 1e-6 * size);
  await page.press("play");
  await page.tab.waitForFunction((last) => window.flbc.points().some((x, k) => x !== last[k]), {}, moved);
  await page.press("play");
  await page.close();
}

async function testButtons(name, theme) {
  const page = await open(name, { theme });
  const { tab } = page;
  const ids = await tab.$$eval("button[id]", (buttons) =>
    buttons.filter((button) => button.checkVisibility()).map((button) => button.id));
  assert.ok(ids.length >= 20);
  await page.ask("select", [0, 1]);
  await page.ask("move", 0, await page.ask("controlPoint", 1));
  await page.ask("undo");
  for (const id of ids.filter((each) => each !== "fold")) {
    if (id === "redo") await page.ask("undo");
    await page.ask("select", [0, 1]);
    await page.press(id);
    if (id === "help") await tab.keyboard.press("Escape");
    if (["play", "theme", "cage", "edges"].includes(id)) await page.press(id);
  }
  await downloaded(`${name}_model_pose.obj`);
  await downloaded(`${name}_model_posed.obj`);
  await downloaded(`${name}_model.png`);
  for (const coloring of ["displacement", "weight", "influences", "shaded"]) {
    await tab.select("#coloring", coloring);
    const shown = await page.picture();
    assert.ok(new Set(shown).size > 20, coloring);
    await tab.screenshot({ path: join(work, `${name}_${theme}_${coloring}.png`) });
  }
  await tab.select("#mirror", "0");
  assert.match(await tab.$eval("#note", (note) => note.textContent),
               /have an image$|have an image; the others move alone. Make the cage with the symmetry x$/);
  await page.press("fold");
  await page.press("fold");
  for (const key of ["?", "Escape", "f", "1", "2", "3", "g", "r", "s", "x", "x", "b", "b", "i", "a",
                     "ArrowLeft", "Delete", "c", "c", "w", "d", "Space", "Space"]) {
    await tab.keyboard.press(key);
  }
  await tab.mouse.move(400, 300);
  await tab.mouse.wheel({ deltaY: -200 });
  await page.picture();
  await page.close();
}

async function testTouch(name) {
  const page = await open(name, { viewport: { width: 420, height: 800, hasTouch: true, isMobile: true } });
  const rest = await page.points();
  const { touchscreen } = page.tab;
  for (let i = 0; i < 20; ++i) {
    const spot = await page.ask("spot", i);
    await touchscreen.touchStart(spot.x, spot.y);
    await touchscreen.touchMove(spot.x + 25, spot.y + 25);
    await touchscreen.touchMove(spot.x + 40, spot.y + 30);
    await touchscreen.touchEnd();
  }
  assert.ok(largestDifference(await page.points(), rest) > 0, "fingers move nothing");
  await page.tab.screenshot({ path: join(work, `${name}_touch.png`) });
  await page.close();
}

// A texture, and a place far from the origin.
async function testTexture() {
  const page = await open("square");
  await page.tab.waitForFunction(() => window.flbc.viewer.renderer.pictures.length === 1);
  const own = await page.picture(join(work, "square_texture.png"));
  await page.tab.select("#coloring", "shaded");
  assert.ok(countDifferent(await page.picture(), own) > 1000);
  await page.ask("move", 2, [1001.5, 501.25]);
  const points = await page.points();
  const expected = vertices(join(work, "square_model.obj"), 2).map((value, k, all) => {
    const weight = (all[k - k % 2] - 1000) * (all[k - k % 2 + 1] - 500);
    return value + weight * (k % 2 === 0 ? 0.5 : 0.25);
  });
  // Single precision has no more digits so far from the origin.
  assert.ok(largestDifference(points, expected) <= 1001.5 * 2 ** -23);
  await page.picture(join(work, "square_moved.png"));
  await page.close();
}

// The graphics card puts the model where the processor does. Only the shading of surfaces differs.
async function testCard(name, dim) {
  const picturesOf = async (hash) => {
    const page = await open(name, { hash });
    await page.ask("move", 1, (await page.ask("controlPoint", 1)).map((x) => 1.05 * x + 0.01));
    await page.press("edges");
    const pictures = [await page.picture(join(work, `${name}_${hash.slice(1)}.png`))];
    await page.tab.select("#coloring", "displacement");
    pictures.push(await page.picture());
    const points = await page.points();
    await page.close();
    return { pictures, points };
  };
  const card = await picturesOf("#card"), processor = await picturesOf("#processor");
  assert.deepEqual(card.points, processor.points);
  for (const [k, picture] of card.pictures.entries()) {
    const background = picture[0];
    const outlines = [picture, processor.pictures[k]].map(
      (pixels) => pixels.map((pixel) => Number(pixel !== background)));
    const drawn = outlines[1].reduce((sum, pixel) => sum + pixel, 0);
    assert.ok(countDifferent(...outlines) < 0.01 * drawn, `${name}: another outline`);
    if (dim === 2) assert.ok(countDifferent(picture, processor.pictures[k]) < 0.01 * drawn);
  }
}

async function testWithoutWebGl() {
  const tab = await browser.newPage();
  await tab.evaluateOnNewDocument(() => { HTMLCanvasElement.prototype.getContext = () => null; });
  await tab.goto(`file://${work}/limb.html`);
  const message = await tab.waitForSelector("#message", { visible: true });
  assert.match(await message.evaluate((node) => node.textContent), /WebGL2/);
  await tab.close();
}

const samples = [["figure", 2, "2d"], ["limb", 3, "3d"]];
try {
  for (const [name, dim, folder] of samples) {
    const file = (what) => join(meshes, folder, `${name}_${what}.obj`);
    const weights = join(work, `${name}.mtx`);
    await testDrag(name, dim, file("model"), weights, file("cage"));
    console.log(`${name}: as flbc deform, in ${await browser.version()}`);
    if (!isChromium) continue;
    await testSelection(name, dim, file("cage"));
    await testPoses(name, dim, file("model"), weights, file("cage_pose"));
    await testDragModel(name, dim, weights);
    await testButtons(name, dim === 2 ? "light" : "dark");
    if (dim === 2) continue;
    await testFirstDrag(name, weights);
    await testBend(name, dim);
    await testPivot(name, dim);
    await testSoftAndLasso(name);
    await testKeptPoses(name, dim, file("cage_pose"));
    await testKeys(name, dim, file("cage_pose"));
    await testTouch(name);
  }
  if (isChromium) {
    await testTexture();
    await testCard("square", 2);
    await testCard("limb", 3);
    await testWithoutWebGl();
  }
} finally {
  await browser.close();
}

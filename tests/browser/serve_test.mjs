// SPDX-License-Identifier: BSD-3-Clause
// flbc view --serve: reshaping a resting cage with the mouse. serve_test.mjs BROWSER PROGRAM MESHES
// With a number of drags and a cage as further arguments it measures them instead.
import assert from "node:assert/strict";
import { execFileSync, spawn } from "node:child_process";
import { mkdtempSync, readFileSync, writeFileSync } from "node:fs";
import { request } from "node:http";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { setTimeout as sleep } from "node:timers/promises";
import { largestDifference, launch, Page, vertices } from "./page.mjs";

const [executablePath, program, meshes, drags, measuredCage] = process.argv.slice(2);
const work = mkdtempSync(join(tmpdir(), "flbc_serve_"));

const browser = await launch(executablePath);

// The program with a page of it.
class Served extends Page {
  static async start(args) {
    const served = new Served();
    served.process = spawn(program, ["view", "--serve", ...args, "-q"]);
    process.on("exit", () => served.process.kill("SIGKILL"));
    served.ended = new Promise((done) => served.process.on("exit", (code) => done(code)));
    served.address = await new Promise((done, fail) => {
      let text = "";
      served.process.stdout.on("data", (data) => {
        text += data;
        if (text.includes("\n")) done(text.trim());
      });
      served.process.stderr.on("data", (data) => fail(new Error(String(data))));
    });
    return served;
  }

  open() {
    return super.open(browser, this.address);
  }

  async drag(i, ...by) {
    return super.drag(await this.ask("spot", i), ...by);
  }

  idle() {
    return this.tab.waitForFunction(() => !window.flbc.reshapes().isBusy, { timeout: 60000 });
  }

  // Kilobytes in memory.
  memory() {
    return Number(/VmRSS:\s+(\d+)/.exec(readFileSync(`/proc/${this.process.pid}/status`, "utf8"))[1]);
  }
}

// The status of a request with headers that a browser would not let a page send.
function statusOf(address, headers, method = "GET") {
  return new Promise((done, fail) => {
    const sent = request(address, { method, headers }, (reply) => {
      reply.resume();
      done(reply.statusCode);
    });
    sent.on("error", fail);
    sent.end(method === "POST" ? "{}" : undefined);
  });
}

// Compressing for a page on the same machine takes longer than all the rest.
function encodingOf(address) {
  return new Promise((done, fail) => {
    request(address, { headers: { "Accept-Encoding": "gzip, br" } }, (reply) => {
      reply.resume();
      done(reply.headers["content-encoding"]);
    }).on("error", fail).end();
  });
}

async function testRefusals(served) {
  const url = new URL(served.address);
  assert.equal(url.hostname, "127.0.0.1");
  assert.match(url.pathname, /^\/[0-9a-f]{32}\/$/);
  assert.equal(await statusOf(served.address, {}), 200);
  assert.equal(await encodingOf(served.address), undefined);
  assert.equal(await statusOf(served.address, { Host: "evil.example" }), 403);
  assert.equal(await statusOf(served.address, { Host: `evil.example:${url.port}` }), 403);
  assert.equal(await statusOf(`${served.address}reshape`, { Origin: "http://evil.example" }, "POST"), 403);
  assert.equal(await statusOf(`${served.address}reshape`, { Origin: "null" }, "POST"), 403);
  assert.equal(await statusOf(`http://127.0.0.1:${url.port}/`, {}), 404);
  assert.equal(await statusOf(`http://127.0.0.1:${url.port}/${"0".repeat(32)}/`, {}), 404);
}

// After a drag of the resting cage the page poses the model as weights for that cage do.
async function testReshaping(folder, name, dim) {
  const cage = join(meshes, folder, `${name}_cage.obj`);
  const model = join(meshes, folder, `${name}_model.obj`);
  const served = await Served.start([cage, model, "--vertices", "800"]);
  if (dim === 2) await testRefusals(served);
  await served.open();
  const rest = vertices(model, dim);
  const size = Math.max(...rest) - Math.min(...rest);
  assert.ok(largestDifference(await served.points(), rest) < 1e-5 * size);
  const count = vertices(cage, dim).length / dim;
  const i = await served.grabbable();
  const before = await served.ask("controlPoint", i);

  await served.press("reshape");
  await served.drag(i, 14, -9);
  await served.idle();
  const moved = await served.ask("controlPoint", i);
  assert.ok(largestDifference(moved, before) > 1e-3 * size, "the cage was not reshaped");
  assert.ok(largestDifference(await served.points(), rest) < 1e-5 * size, "the model moved");
  const reshaped = join(work, `${name}_reshaped.obj`);
  writeFileSync(reshaped, await served.ask("pose"));
  await served.tab.screenshot({ path: join(work, `${name}.png`) });

  // Posed from the reshaped cage, it reproduces affine maps, whatever the weights.
  await served.press("reshape");
  for (let k = 0; k < count; ++k) {
    const place = await served.ask("controlPoint", k);
    await served.ask("move", k, place.map((value) => 1.5 * value));
  }
  const scaled = (await served.points()).map((value) => value / 1.5);
  assert.ok(largestDifference(scaled, rest) < 1e-5 * size);
  await served.ask("undo");

  // A shape that its solver cannot take is refused, and the last one comes back.
  await served.press("resetAll");
  await served.press("reshape");
  const kept = await served.ask("controlPoint", i);
  await served.drag(i, 900, 700, 2);
  await served.idle();
  const after = await served.ask("controlPoint", i);
  assert.ok(largestDifference(after, kept) < 1e-9 * size, "a refused shape stayed");
  assert.deepEqual(served.failures, []);

  // Loaded again it is where it was; closed, the program ends.
  await served.tab.reload();
  await served.loaded();
  assert.ok(largestDifference(await served.ask("controlPoint", i), kept) < 1e-9 * size);
  await served.tab.close();
  assert.equal(await Promise.race([served.ended, sleep(20000).then(() => "still there")]), 0);
}

// Cancelled while it is solved, a new shape leaves no trace.
async function testCancel() {
  const cage = join(meshes, "3d", "limb_cage.obj");
  const model = join(meshes, "3d", "limb_model.obj");
  const served = await Served.start([cage, model, "--vertices", "6000"]);
  await served.open();
  const rest = vertices(model, 3);
  const size = Math.max(...rest) - Math.min(...rest);
  const i = await served.grabbable();
  const kept = await served.ask("controlPoint", i);
  const step = 0.1 * size;
  const posed = async () => {
    await served.ask("move", i, kept.map((value) => value + step));
    const points = await served.points();
    await served.ask("undo");
    return points;
  };
  const before = await posed();

  await served.press("reshape");
  await served.drag(i, 40, -30, 1);
  assert.ok((await served.ask("reshapes")).isBusy, "there is nothing to cancel");
  await served.press("stop");
  await served.idle();
  assert.deepEqual(await served.ask("controlPoint", i), kept);
  assert.ok(largestDifference(await served.points(), rest) < 1e-5 * size, "the model moved");
  await served.press("reshape");
  assert.ok(largestDifference(await posed(), before) < 0.02 * step, "weights of another shape");
  await served.close();
  assert.equal(await served.ended, 0);
}

async function testInterrupt() {
  const served = await Served.start([join(meshes, "2d", "letter_cage.obj"), "--vertices", "300"]);
  served.process.kill("SIGINT");
  assert.equal(await served.ended, 0);
  assert.throws(() => execFileSync(program, ["view", "--serve", "absent.obj"], { stdio: "pipe" }));
}

// A browser opens six connections to the program at most, however many pages it shows.
async function testManyPages() {
  const served = await Served.start([join(meshes, "2d", "letter_cage.obj"), "--vertices", "300"]);
  const tabs = [];
  for (let k = 0; k < 10; ++k) {
    await served.open();
    tabs.push(served.tab);
    assert.deepEqual(served.failures, []);
  }
  // The page that holds the connection of all goes first.
  for (const tab of tabs.slice(0, -1)) await tab.close();
  await sleep(4000);
  await served.tab.reload();
  await served.loaded();
  await served.tab.close();
  assert.equal(await Promise.race([served.ended, sleep(20000).then(() => "still there")]), 0);
}

function median(values) {
  return values.sort((a, b) => a - b)[Math.floor(values.length / 2)];
}

// Real drags there and back, each followed by its solve.
async function measure(cage, numDrags) {
  const served = await Served.start([cage, "--vertices", "2000"]);
  await served.open();
  const count = vertices(cage, 2).length / 2;
  await served.press("reshape");
  let early = 0;
  for (let k = 0; k < numDrags; ++k) {
    const turn = 2 * Math.PI * k / 12;
    const i = Math.floor(k / 2) % count;
    await served.drag(i, (k % 2 ? -1 : 1) * 6 * Math.cos(turn), (k % 2 ? -1 : 1) * 6 * Math.sin(turn), 1);
    await served.idle();
    if (k === Math.floor(numDrags / 5)) early = served.memory();
  }
  const { milliseconds, solveMilliseconds } = await served.ask("reshapes");
  console.log(`${numDrags} drags, ${milliseconds.length} solves: median ${median(milliseconds).toFixed(1)} ms in the page, `
    + `${median(solveMilliseconds).toFixed(1)} ms in the program, longest ${Math.max(...milliseconds).toFixed(0)} ms; memory ${early} kB after a fifth, `
    + `${served.memory()} kB at the end`);
  await served.close();
  await served.ended;
}

try {
  if (drags) {
    await measure(measuredCage, Number(drags));
  } else {
    await testInterrupt();
    await testManyPages();
    await testReshaping("2d", "figure", 2);
    await testReshaping("3d", "limb", 3);
    await testCancel();
    console.log("resting cages are reshaped");
  }
} finally {
  await browser.close();
}

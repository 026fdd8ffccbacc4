// SPDX-License-Identifier: BSD-3-Clause
// The module in Node.js against the program: node node_test.mjs MODULE PROGRAM MESHES WORK
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { pathToFileURL } from "node:url";

const [modulePath, program, meshes, work] = process.argv.slice(2);
const { Flbc } = await import(pathToFileURL(modulePath));
const flbc = await Flbc.start();
const run = (...args) => execFileSync(program, [...args, "-q"], { cwd: work });
const put = (name, bytes) => writeFileSync(join(work, name), bytes);

// The numbers of a .npy file.
function numbersIn(bytes) {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  const begin = 10 + view.getUint16(8, true);
  return Float64Array.from({ length: (bytes.length - begin) / 8 }, (_, k) => view.getFloat64(begin + 8 * k, true));
}

function largestDifference(a, b) {
  assert.equal(a.length, b.length);
  return a.reduce((most, value, k) => Math.max(most, Math.abs(value - b[k])), 0);
}

// Lines of a file that begin with a word, as numbers.
function linesOf(bytes, word) {
  return new TextDecoder().decode(bytes).split("\n").filter((line) => line.startsWith(`${word} `))
    .map((line) => line.split(/\s+/).slice(1).map(Number));
}

// Rounding differs between processors, and may change the order of control points.
function expectSameCage(own, native) {
  const [points, others] = [own, native].map((file) => linesOf(file, "v"));
  const numbers = points.map((point) => 1 + others.findIndex((other) => largestDifference(point, other) < 1e-12));
  assert.equal(new Set(numbers).size, others.length);
  assert.ok(!numbers.includes(0), "a control point is elsewhere");
  const inOrder = (facets) => facets.map((facet) => {
    const first = facet.indexOf(Math.min(...facet));
    return [...facet.slice(first), ...facet.slice(0, first)].join(" ");
  }).sort();
  const named = ["f", "l"].map((word) => linesOf(own, word).map((facet) => facet.map((i) => numbers[i - 1])));
  assert.deepEqual(inOrder(named.flat()), inOrder(["f", "l"].flatMap((word) => linesOf(native, word))));
}

for (const [name, dim] of [["2d/figure_model.obj", 2], ["3d/limb_model.obj", 3]]) {
  const model = readFileSync(join(meshes, name));
  put("model.obj", model);
  const facts = await flbc.readModel("model.obj", model);
  assert.equal(facts.dim, dim);
  const stages = new Set();
  const note = (stage) => stages.add(stage);
  const made = await flbc.makeCage({ controlPoints: 40 }, note);
  put("cage.obj", await flbc.cageFile());
  run("cage", "model.obj", "--control-points", "40", "-o", "native.obj");
  const [own, native] = ["cage.obj", "native.obj"].map((file) => readFileSync(join(work, file)));
  expectSameCage(own, native);
  assert.equal(linesOf(own, "v").length, made.controlPoints);
  const places = await flbc.points();
  const density = new Float64Array(places.length / dim).map((_, v) => (places[dim * v] > 0 ? 6 : 1));
  writeFileSync(join(work, "density.csv"), density.join("\n"));
  await flbc.makeCage({ controlPoints: 40, density });
  put("dense.obj", await flbc.cageFile());
  run("cage", "model.obj", "--control-points", "40", "--density", "density.csv", "-o", "native.obj");
  expectSameCage(...["dense.obj", "native.obj"].map((file) => readFileSync(join(work, file))));
  await assert.rejects(flbc.makeCage({ density: [1] }), { name: "OptionError", message: /each of/ });
  await flbc.readCage("cage.obj", own);

  const domain = dim === 2 ? "domain.obj" : "domain.mesh";
  await flbc.makeMesh({ vertices: 3000 }, note);
  put(domain, await flbc.meshFile());
  const { converged } = await flbc.solve({ distances: "exact" }, note);
  assert.ok(converged);
  assert.ok(stages.has("filling the cage") && stages.has("solving"), [...stages].join());
  run("solve", "cage.obj", "--domain", domain, "--distances", "exact", "-o", "native.npy");
  const weights = numbersIn(await flbc.weightFile({ of: "mesh" }));
  const difference = largestDifference(weights, numbersIn(readFileSync(join(work, "native.npy"))));
  console.log(`${name}: weights of the mesh within ${difference}`);
  assert.ok(difference < 1e-5);

  // Control points moved as a whole take the model along; any others as flbc deform does.
  const points = await flbc.points();
  const { points: rest } = await flbc.cage();
  const shifted = await flbc.deform(rest.map((place) => place + 1));
  assert.ok(largestDifference(shifted, points.map((place) => place + 1)) < 1e-9);
  const pose = rest.map((place, k) => place * (1 + 0.1 * Math.sin(k)));
  put("pose.obj", new TextEncoder().encode(Array.from({ length: pose.length / dim }, (_, i) =>
    `v ${[...pose.slice(dim * i, dim * i + dim)].join(" ")}${dim === 2 ? " 0" : ""}`).join("\n") + "\n"));
  put("weights.npy", await flbc.weightFile());
  put("posed.obj", await flbc.modelFile(pose, "obj"));
  run("deform", "model.obj", "--weights", "weights.npy", "--pose", "pose.obj", "-o", "moved.obj");
  const [posed, moved] = ["posed.obj", "moved.obj"].map((file) => linesOf(readFileSync(join(work, file)), "v").flat());
  assert.ok(largestDifference(posed, moved) < 1e-9);

  // A new worker goes on with the solution.
  const solution = await flbc.solution();
  const before = await flbc.weightFile();
  await flbc.cancel();
  await flbc.readModel("model.obj", model);
  await flbc.readCage("cage.obj", own);
  await flbc.setSolution(solution);
  assert.deepEqual(await flbc.weightFile(), before);

  const { rest: reshaped } = await flbc.move({ points: [...rest.map((place, k) => (k === 0 ? 1.00001 * place : place))] });
  assert.equal(reshaped[0], 1.00001 * rest[0]);
  put("rig.glb", await flbc.glb({ influences: 8 }));
  assert.match(String(execFileSync(program, ["info", "rig.glb"], { cwd: work })), /skin of 4\d joints/);
  assert.match(new TextDecoder().decode(await flbc.page()), /<html/);
}

// Errors are those of the program, and the next call works.
await assert.rejects(flbc.readModel("bad.obj", new TextEncoder().encode("v 0 0 zero\n")),
                     { name: "InputError", message: /^bad.obj:1: expected a number/ });
await assert.rejects(flbc.readModel("bad.xyz", new Uint8Array(3)), { name: "OptionError" });
const limb = readFileSync(join(meshes, "3d/limb_model.obj"));
await flbc.readModel("limb.obj", limb);
const pyramid = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nf 1 2 5\nf 2 3 5\nf 3 4 5\nf 4 1 5\n";
await assert.rejects(flbc.readCage("open.obj", new TextEncoder().encode(pyramid)),
                     (error) => error.name === "DefectiveCage" && error.controlPoints.length > 0);

const small = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n";
await flbc.readCage("small.obj", new TextEncoder().encode(small));
await assert.rejects(flbc.makeMesh(), { name: "InputError", message: /limb.obj: \d+ of 3352 vertices are outside the cage.*; enlarge the cage/ });

// A long call is cancelled at once; then everything works as before.
const pending = flbc.makeCage({ controlPoints: 300 });
await new Promise((done) => setTimeout(done, 100));
const begin = process.cpuUsage();
await Promise.all([assert.rejects(pending, { name: "Cancelled" }), flbc.cancel()]);
assert.ok(process.cpuUsage(begin).user < 1e6);  // microseconds
await flbc.readModel("limb.obj", limb);
await flbc.readCage("cage.obj", readFileSync(join(meshes, "3d/limb_cage.obj")));
await flbc.makeMesh({ vertices: 1000 });
await flbc.solve();

// Masks: exact zeros after each step, in agreement with the program. A conflict has its cure.
const places = { model: await flbc.points(), cage: (await flbc.cage()).points };
const xs = (points) => Array.from({ length: points.length / 3 }, (_, i) => points[3 * i]);
const low = Math.min(...xs(places.cage)), size = Math.max(...xs(places.cage)) - low;
const numbersWhere = (points, accepts) => xs(points).flatMap((x, i) => (accepts((x - low) / size) ? [i] : []));
const controlPoints = numbersWhere(places.cage, (x) => x > 0.6), vertices = numbersWhere(places.model, (x) => x < 0.4);
const expectObeyed = ({ starts, controlPoints: owners, values }) => {
  for (const v of vertices) for (let k = starts[v]; k < starts[v + 1]; ++k) assert.ok(values[k] === 0 || !controlPoints.includes(owners[k]));
};
const masks = [{ control_points: controlPoints, region: { vertices } }];
const { masks: taken, conflict: none } = await flbc.protect(masks);
assert.deepEqual(taken, [{ controlPoints, vertices }]);
assert.equal(none, undefined);
for (let isDone = false; !isDone;) {
  const { converged, weights } = await flbc.move({ refine: true });
  expectObeyed(weights);
  isDone = converged;
}
expectObeyed(await flbc.weights());
put("limb.obj", limb);
put("limb_cage.obj", await flbc.cageFile());
put("limb.mesh", await flbc.meshFile());
put("masks.json", JSON.stringify(masks));
run("solve", "limb_cage.obj", "--domain", "limb.mesh", "--model", "limb.obj", "--locality", "masks.json", "-o", "masked.npy");
const [resumed, cold] = [await flbc.weightFile(), readFileSync(join(work, "masked.npy"))].map(numbersIn);
const squares = resumed.reduce((sum, value, k) => sum + (value - cold[k]) ** 2, 0);
console.log(`masked weights: rms difference from a cold solve ${Math.sqrt(squares / resumed.length)}`);
assert.ok(squares < 1e-3 * places.model.length / 3);
await flbc.reduce({ influences: 8 });
expectObeyed(await flbc.weights());
const impossible = [{ control_points: [...Array(places.cage.length / 3).keys()], region: [0, 5] }];
const { conflict } = await flbc.protect(impossible);
assert.deepEqual(conflict.vertices, [0, 5]);
expectObeyed(await flbc.weights());  // as before
const relaxed = await flbc.protect({ masks: impossible, conflicts: "relax" });
assert.equal(relaxed.conflict, undefined);
assert.deepEqual(relaxed.freed, conflict.controlPoints);
await assert.rejects(flbc.protect([{ control_points: [999], region: [0] }]), { name: "InputError", message: /^locality.json: .*control point 999/ });

// A larger reach extends the weights of its control points.
const meanWith = async (factor) => {
  const { reach } = await flbc.protect({ reach: [{ control_points: controlPoints, factor }] });
  assert.deepEqual([...reach.keys()].filter((i) => reach[i] === factor), controlPoints);
  let reply;
  do reply = await flbc.move({ refine: true }); while (!reply.converged);
  return reply.weights.values.reduce((sum, value, k) => sum + (controlPoints.includes(reply.weights.controlPoints[k]) ? value : 0), 0);
};
const near = await meanWith(0.25);
assert.ok(await meanWith(4) > 1.02 * near);
assert.equal((await flbc.protect({ masks: [], falloff: 0.1 })).falloff, 0.1);
await assert.rejects(flbc.protect({ masks: [], falloff: 2 }), { message: /falloff must be in \[0, 1\]/ });
await flbc.protect([]);

// Control points that move those of the cage, such as handles of curves: poses of both agree, and weights
// are coordinates, also after masks and with another shape at rest.
{
  const { curvedCage, piecesOf } = await import(new URL("../../web/page/cage_edits.mjs", import.meta.url));
  const figure = readFileSync(join(meshes, "2d/figure_model.obj"));
  await flbc.readModel("figure.obj", figure);
  await flbc.readCage("cage.obj", readFileSync(join(meshes, "2d/figure_cage.obj")));
  const { points: corners, facets } = await flbc.cage();
  const curved = curvedCage({ points: [...corners], facets: [...facets] }), count = curved.points.length / 2;
  const { cage, map } = piecesOf(curved);
  const through = (places) => map.starts.slice(1).flatMap((end, i) => [0, 1].map((c) => {
    let sum = 0;
    for (let k = map.starts[i]; k < end; ++k) sum += map.values[k] * places[2 * map.controlPoints[k] + c];
    return sum;
  }));
  const pose = curved.points.map((place, k) => place + 0.3 * Math.sin(k));
  await flbc.setCage(cage.points, cage.facets);
  await flbc.makeMesh({ vertices: 2000 });
  await flbc.solve();
  const solution = await flbc.solution(), moved = await flbc.deform(through(pose));
  await flbc.setCage(cage.points, cage.facets);
  await flbc.compose({ ...curved, ...map, isCurved: true });
  await flbc.setSolution(solution);
  const points = await flbc.points();
  assert.deepEqual([...(await flbc.cage()).points], curved.points);
  assert.ok(largestDifference(await flbc.deform(pose), moved) < 1e-9);
  const expectCoordinates = async (rest) => {
    const { starts, values } = await flbc.weights();
    assert.ok(values.every((value) => value >= 0));
    for (let p = 0; p + 1 < starts.length; ++p) {
      assert.ok(Math.abs(values.slice(starts[p], starts[p + 1]).reduce((sum, value) => sum + value, 0) - 1) < 1e-5);
    }
    assert.ok(largestDifference(await flbc.deform(rest), points) < 1e-6);
  };
  await expectCoordinates(curved.points);
  assert.ok(JSON.parse(new TextDecoder().decode(await flbc.content())).cage.isCurved);
  assert.equal(linesOf(await flbc.cageFile(), "v").length, count);

  const held = count / 3;  // a handle
  const { starts, controlPoints, values } = await flbc.weights();
  const region = Array.from({ length: starts.length - 1 }, (_, p) => p)
    .filter((p) => [...controlPoints.slice(starts[p], starts[p + 1])].some((i, k) => i === held && values[starts[p] + k] > 0)).slice(0, 5);
  assert.equal(region.length, 5);
  const { masks, conflict } = await flbc.protect([{ control_points: [held], region: { vertices: region } }]);
  assert.equal(conflict, undefined);
  assert.deepEqual(masks, [{ controlPoints: [held], vertices: region }]);
  await flbc.move({ refine: true, seconds: 60 });
  const step = await flbc.deform(curved.points.map((place, k) => place + (k === 2 * held ? 1 : 0)));
  for (const p of region) assert.equal(step[2 * p], points[2 * p]);
  assert.notDeepEqual(step, points);
  await flbc.protect([]);

  const rest = curved.points.map((place, k) => (k >= 2 * held ? place + 0.02 * Math.sin(k) : place));
  const reply = await flbc.move({ points: rest, seconds: 60 });
  assert.equal(reply.refused, undefined);
  assert.deepEqual([...reply.rest], rest);
  await expectCoordinates(rest);
  assert.match((await flbc.move({ points: rest.map(() => 0) })).refused, /./);
  assert.deepEqual([...(await flbc.cage()).points], rest);
}

// Arrays instead of files.
const mesh = { points: [0.1, 0.1, 0.1, 0.2, 0.1, 0.1, 0.1, 0.2, 0.1], triangles: [0, 1, 2] };
await flbc.setModel(mesh.points, mesh.triangles);
await flbc.setCage([0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1], [0, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 2]);
await flbc.setMesh([0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1], [0, 1, 2, 3]);
await flbc.solve();
assert.deepEqual([...(await flbc.weights()).starts], [0, 4, 8, 12]);

// Another cage ends what was computed with the one before.
await flbc.reduce({ influences: 4 });
await flbc.setCage([0, 0, 0, 2, 0, 0, 0, 2, 0, 0, 0, 2], [0, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 2]);
await assert.rejects(flbc.weights(), { name: "OptionError", message: /no mesh of the cage yet/ });

// Cages replace no file of the model, whatever their names are.
for (const name of ["cage.obj", "posed.obj"]) {
  await flbc.readModel(name, limb);
  await flbc.readCage(name, readFileSync(join(meshes, "3d/limb_cage.obj")));
  await flbc.makeMesh({ vertices: 1000 });
  await flbc.solve();
  for (let k = 0; k < 2; ++k) {
    assert.equal(linesOf(await flbc.modelFile((await flbc.cage()).points), "v").length, 3352, name);
  }
}

// A refused model leaves none behind.
await assert.rejects(flbc.readModel("one.obj", new TextEncoder().encode("v 0 0 0\n")));
await assert.rejects(flbc.points(), { name: "OptionError", message: /there is no model yet/ });

// Files in folders, and names that no file can have.
const binary = Uint8Array.from([...new Uint8Array(Float32Array.of(0, 0, 0, 1, 0, 0, 0, 1, 0).buffer)]);
const triangle = { asset: { version: "2.0" }, scenes: [{ nodes: [0] }], nodes: [{ mesh: 0 }], meshes: [{ primitives: [{ attributes: { POSITION: 0 } }] }],
                   accessors: [{ bufferView: 0, componentType: 5126, count: 3, type: "VEC3", min: [0, 0, 0], max: [1, 1, 0] }],
                   bufferViews: [{ buffer: 0, byteLength: 36 }], buffers: [{ byteLength: 36, uri: "parts/a/points.bin" }] };
const text = new TextEncoder().encode(JSON.stringify(triangle));
assert.equal((await flbc.readModel("triangle.gltf", text, { "parts/a/points.bin": binary })).vertices, 3);
await assert.rejects(flbc.addFile("parts/a", binary), { name: "InputError", message: /^parts\/a: / });
flbc.end();

// SPDX-License-Identifier: BSD-3-Clause
// Models in glTF have the same points in WebAssembly as in the program:
//   node gltf_test.mjs MODULE PROGRAM FOLDER WORK
// FOLDER: with files of other tests, in subfolders.
import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { readdirSync, readFileSync, writeFileSync } from "node:fs";
import { basename, join } from "node:path";
import { pathToFileURL } from "node:url";

const [modulePath, program, folder, work] = process.argv.slice(2);
const { Flbc } = await import(pathToFileURL(modulePath));
const flbc = await Flbc.start();

let seed = 1;
const random = () => { seed = (48271 * seed) % 2147483647; return seed / 1073741823.5 - 1; };
const randoms = (count) => Array.from({ length: count }, random);
const cross = (a, b) => a.map((_, k) => a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3]);

// A node that translates, turns, and scales, and what it does to a point.
function randomNode() {
  const turn = randoms(4), length = Math.hypot(...turn);
  return { translation: randoms(3), rotation: turn.map((value) => value / length), scale: randoms(3).map((value) => 1 + value / 2) };
}
function placed({ translation, rotation: [x, y, z, w], scale }, point) {
  const p = point.map((value, k) => scale[k] * value), once = cross([x, y, z], p), twice = cross([x, y, z], once);
  return p.map((value, k) => translation[k] + value + 2 * (w * once[k] + twice[k]));
}

// A chain of nodes, each with a tetrahedron, and a tetrahedron that they move as joints, two for each corner.
const kCorners = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], kTriangles = [0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3];
function chain() {
  const nodes = Array.from(kCorners, (_, k) => ({ ...randomNode(), mesh: 0, ...(k < 3 && { children: [k + 1] }) }));
  const inScene = (corner, k) => nodes.slice(0, k + 1).reduceRight((point, node) => placed(node, point), corner);
  const skinned = (corner, k) => inScene(corner, k).map((value, axis) => (value + inScene(corner, (k + 1) % 4)[axis]) / 2);
  const binary = Buffer.concat([Float32Array.from(kCorners.flat()), Uint16Array.from(kTriangles),
                                Uint8Array.from(kCorners.flatMap((_, k) => [k, (k + 1) % 4, 0, 0])),
                                Float32Array.from(kCorners.flatMap(() => [0.5, 0.5, 0, 0]))].map(({ buffer }) => Buffer.from(buffer)));
  const sizes = [48, 24, 16, 64];
  const document = {
    asset: { version: "2.0" }, scene: 0, scenes: [{ nodes: [0, 4] }], nodes: [...nodes, { mesh: 1, skin: 0 }], skins: [{ joints: [0, 1, 2, 3] }],
    meshes: [{}, { JOINTS_0: 2, WEIGHTS_0: 3 }].map((more) => ({ primitives: [{ attributes: { POSITION: 0, ...more }, indices: 1 }] })),
    accessors: [[5126, 4, "VEC3"], [5123, 12, "SCALAR"], [5121, 4, "VEC4"], [5126, 4, "VEC4"]].map(([componentType, count, type], bufferView) =>
      ({ bufferView, componentType, count, type, ...(bufferView === 0 && { min: [0, 0, 0], max: [1, 1, 1] }) })),
    bufferViews: sizes.map((byteLength, k) => ({ buffer: 0, byteLength, byteOffset: sizes.slice(0, k).reduce((a, b) => a + b, 0) })),
    buffers: [{ byteLength: binary.length, uri: `data:application/octet-stream;base64,${binary.toString("base64")}` }],
  };
  return { bytes: Buffer.from(JSON.stringify(document)),
           points: [...nodes.flatMap((_, k) => kCorners.map((corner) => inScene(corner, k))), ...kCorners.map(skinned)].flat() };
}

function expectEqual(points, others, name) {
  assert.equal(points.length, others.length, name);
  const size = points.reduce((most, value) => Math.max(most, Math.abs(value)), 0);
  points.forEach((value, k) => assert.ok(Math.abs(value - others[k]) <= 1e-12 * size, `${name}: ${value}, not ${others[k]}`));
}

// The points of a file that the program reads, or nothing.
async function expectSame(name, bytes) {
  const path = join(work, name);
  writeFileSync(path, bytes);
  const { status } = spawnSync(program, ["convert", name, "-q", "-o", "native.obj"], { cwd: work });
  if (status !== 0) return assert.rejects(flbc.readModel(name, bytes));
  const { dim } = await flbc.readModel(name, bytes), points = await flbc.points();
  const native = readFileSync(join(work, "native.obj"), "utf8").split("\n").filter((line) => line.startsWith("v "))
    .flatMap((line) => line.split(" ").slice(1, dim + 1).map(Number));
  expectEqual(points, native, name);
  return points;
}

for (let k = 0; k < 20; ++k) {
  const { bytes, points } = chain();
  expectEqual(await expectSame(`chain_${k}.gltf`, bytes), points, `chain ${k}`);
}
const left = readdirSync(folder, { recursive: true }).filter((path) => /\.gl(b|tf)$/.test(path) && !/node_modules/.test(path));
for (const path of left) await expectSame(basename(path), readFileSync(join(folder, path)));
console.log(`${left.length} other files in glTF have the same points`);
flbc.end();

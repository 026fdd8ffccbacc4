// SPDX-License-Identifier: BSD-3-Clause
// Compressed glTF files, as gltfpack and Blender write them, become plain ones:
//   node decoding_test.mjs PROGRAM MESHES WORK
// The compressed files of page_test.mjs are left in WORK.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { readFileSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { gzipSync } from "node:zlib";
import { decoded } from "../../web/page/decoding.mjs";

const [program, meshes, work] = process.argv.slice(2);
const folder = new URL("../../web/decoders/node_modules/", import.meta.url);
const require = createRequire(folder);
Object.assign(globalThis, { require, __dirname: "." });  // Draco wants them in Node.js
const packed = (path) => gzipSync(readFileSync(new URL(path, folder))).toString("base64");
const assets = { draco: packed("draco3dgltf/draco_decoder_gltf_nodejs.js"),
                 dracoWasm: packed("draco3dgltf/draco_decoder_gltf.wasm"), meshopt: packed("meshoptimizer/meshopt_decoder.mjs") };

const points = [], corners = [];
for (const line of readFileSync(`${meshes}/3d/limb_model.obj`, "utf8").split("\n")) {
  const words = line.trim().split(/\s+/);
  if (words[0] === "v") points.push(...words.slice(1, 4).map(Number));
  if (words[0] === "f") corners.push(...words.slice(1, 4).map((word) => parseInt(word, 10) - 1));
}
const positions = new Float32Array(points), indices = new Uint32Array(corners), count = points.length / 3;

function document(extension, views, length) {
  const range = (f) => [0, 1, 2].map((k) => f(...positions.filter((_, i) => i % 3 === k)));
  return { asset: { version: "2.0" }, scene: 0, scenes: [{ nodes: [0] }], nodes: [{ mesh: 0, name: "limb" }],
           extensionsUsed: [extension], extensionsRequired: [extension], buffers: [{ byteLength: length }], bufferViews: views,
           materials: [{ name: "skin", pbrMetallicRoughness: { baseColorFactor: [0.8, 0.5, 0.4, 1] } }],
           meshes: [{ primitives: [{ attributes: { POSITION: 0 }, indices: 1, material: 0 }] }],
           accessors: [{ componentType: 5126, count, type: "VEC3", min: range(Math.min), max: range(Math.max) },
                       { componentType: 5125, count: indices.length, type: "SCALAR" }] };
}

function glb(json, binary) {
  const text = Buffer.from(JSON.stringify(json)), pad = (bytes, by) => Buffer.concat([bytes, Buffer.alloc(-bytes.length & 3, by)]);
  const chunk = (bytes, kind) => {
    const head = Buffer.alloc(8);
    head.writeUInt32LE(bytes.length, 0);
    head.write(kind, 4, "latin1");
    return Buffer.concat([head, bytes]);
  };
  const chunks = Buffer.concat([chunk(pad(text, " "), "JSON"), chunk(pad(Buffer.from(binary), 0), "BIN\0")]);
  const head = Buffer.from("glTF\x02\0\0\0\0\0\0\0", "latin1");
  head.writeUInt32LE(12 + chunks.length, 8);
  return Buffer.concat([head, chunks]);
}

async function byMeshopt() {
  const { MeshoptEncoder } = await import(new URL("meshoptimizer/index.js", folder));
  await MeshoptEncoder.ready;
  const parts = [MeshoptEncoder.encodeGltfBuffer(new Uint8Array(positions.buffer), count, 12, "ATTRIBUTES"),
                 MeshoptEncoder.encodeGltfBuffer(new Uint8Array(indices.buffer), indices.length, 4, "TRIANGLES")];
  const ends = [0, parts[0].length + (-parts[0].length & 3)];
  const binary = Buffer.alloc(ends[1] + parts[1].length);
  parts.forEach((bytes, k) => binary.set(bytes, ends[k]));
  const kName = "EXT_meshopt_compression";
  const views = [[12, count, "ATTRIBUTES"], [4, indices.length, "TRIANGLES"]].map(([byteStride, count, mode], k) => ({
    buffer: 1, byteOffset: k === 0 ? 0 : 12 * positions.length / 3, byteLength: byteStride * count, ...(k === 0 && { byteStride }),
    extensions: { [kName]: { buffer: 0, byteOffset: ends[k], byteLength: parts[k].length, byteStride, count, mode } } }));
  const json = document(kName, views, binary.length);
  json.buffers.push({ byteLength: 12 * count + 4 * indices.length, extensions: { [kName]: { fallback: true } } });
  json.accessors.forEach((accessor, k) => { accessor.bufferView = k; });
  return glb(json, binary);
}

async function byDraco() {
  const draco = await require("draco3dgltf").createEncoderModule({});
  const encoder = new draco.Encoder(), builder = new draco.MeshBuilder(), mesh = new draco.Mesh();
  builder.AddFacesToMesh(mesh, indices.length / 3, indices);
  const id = builder.AddFloatAttributeToMesh(mesh, draco.POSITION, count, 3, positions);
  encoder.SetAttributeQuantization(draco.POSITION, 14);
  const array = new draco.DracoInt8Array();
  const length = encoder.EncodeMeshToDracoBuffer(mesh, array);
  const binary = Uint8Array.from({ length }, (_, k) => array.GetValue(k));
  const json = document("KHR_draco_mesh_compression", [{ buffer: 0, byteLength: length }], length);
  json.meshes[0].primitives[0].extensions = { KHR_draco_mesh_compression: { bufferView: 0, attributes: { POSITION: id } } };
  return glb(json, binary);
}

// The corners of all triangles, in an order of their own.
function triangles(path) {
  const found = [], all = [];
  for (const line of readFileSync(path, "utf8").split("\n")) {
    const words = line.trim().split(/\s+/);
    if (words[0] === "v") found.push(words.slice(1, 4).map(Number));
    if (words[0] === "f") all.push(words.slice(1, 4).map((word) => found[parseInt(word, 10) - 1]));
  }
  return all;
}

const expected = triangles(`${meshes}/3d/limb_model.obj`);
for (const [name, bytes, tolerance] of [["meshopt", await byMeshopt(), 1e-6], ["draco", await byDraco(), 1e-3]]) {
  writeFileSync(`${work}/limb_${name}.glb`, bytes);
  assert.throws(() => execFileSync(program, ["convert", `${work}/limb_${name}.glb`, "-o", `${work}/none.obj`], { stdio: "pipe" }));
  const model = { name: `limb_${name}.glb`, bytes: Uint8Array.from(bytes).buffer, files: {} };
  const plain = await decoded(model, assets);
  const path = `${work}/limb_${name}_plain.glb`;
  writeFileSync(path, plain.bytes);
  assert.equal(await decoded({ ...plain, bytes: plain.bytes.slice().buffer }, assets).then(({ name }) => name), model.name);
  execFileSync(program, ["convert", path, "-o", `${work}/${name}.obj`, "-q"], { stdio: "pipe" });
  // As sets, because encoders change the order.
  const found = triangles(`${work}/${name}.obj`);
  assert.equal(found.length, expected.length);
  const key = (triangle) => triangle.map((p) => p.map(Math.fround).join()).sort().join(" ");
  const keys = new Set(expected.map(key));
  const centers = (list) => [0, 1, 2].map((k) => list.reduce((sum, t) => sum + t[0][k] + t[1][k] + t[2][k], 0) / (3 * list.length));
  centers(found).forEach((x, k) => assert.ok(Math.abs(x - centers(expected)[k]) < tolerance, `${name}: the center is elsewhere`));
  const area = (list) => list.reduce((sum, [a, b, c]) => {
    const u = a.map((x, k) => b[k] - x), v = a.map((x, k) => c[k] - x);
    return sum + Math.hypot(u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]) / 2;
  }, 0);
  assert.ok(Math.abs(area(found) / area(expected) - 1) < tolerance, `${name}: another area`);
  if (name === "meshopt") assert.ok(found.every((triangle) => keys.has(key(triangle))), "other triangles");
  execFileSync(program, ["check", path], { stdio: "pipe" });
}
const broken = await byDraco();
broken.fill(7, broken.indexOf("DRACO"));
await assert.rejects(decoded({ name: "broken.glb", bytes: Uint8Array.from(broken).buffer, files: {} }, assets), /broken.glb: the compressed mesh is damaged/);
const text = { name: "text.glb", bytes: new TextEncoder().encode("no glTF").buffer, files: {} };
assert.equal(await decoded(text, assets), text);
console.log("compressed glTF is decoded");

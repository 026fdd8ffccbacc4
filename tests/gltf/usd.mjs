// SPDX-License-Identifier: BSD-3-Clause
// Whether three.js finds the skin of a .usda file, at rest as the model:
//   node usd.mjs SKIN.usda MODEL.obj BONES
import { readFileSync } from 'node:fs';
import { Vector3 } from 'three';
import { USDLoader } from 'three/addons/loaders/USDLoader.js';

const [skin, model, bones] = process.argv.slice(2);
const rounded = (numbers) => numbers.map((x) => Math.round(x * 1e4) + 0).join(' ');
const vertices = readFileSync(model, 'utf8').split('\n').filter((line) => line.startsWith('v '))
  .map((line) => line.trim().split(/\s+/).slice(1, 4).map(Number));
const known = new Set();
for (const point of vertices) {  // with the neighbors in the grid of the rounding
  for (let k = 0; k < 27; ++k) known.add(rounded(point.map((x, axis) => x + 5e-5 * (Math.floor(k / 3 ** axis) % 3 - 1))));
}
const meshes = [];
const scene = new USDLoader().parse(readFileSync(skin, 'utf8'));
scene.updateMatrixWorld(true);
scene.traverse((object) => { if (object.isSkinnedMesh) meshes.push(object); });
if (meshes.length !== 1) throw new Error(`${skin}: ${meshes.length} skins`);
const [mesh] = meshes;
if (mesh.skeleton.bones.length !== Number(bones)) throw new Error(`${mesh.skeleton.bones.length} bones`);
const seen = new Set();
for (let v = 0; v < mesh.geometry.attributes.position.count; ++v) {
  const point = mesh.getVertexPosition(v, new Vector3()).applyMatrix4(mesh.matrixWorld).toArray();
  if (!known.has(rounded(point))) throw new Error(`vertex ${v} is at ${point}`);
  seen.add(rounded(point));
}
if (seen.size < 0.9 * vertices.length) throw new Error(`${seen.size} of ${vertices.length} vertices`);

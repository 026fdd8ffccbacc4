// SPDX-License-Identifier: BSD-3-Clause
// Writes a cage with two joints, of which the second turns within a second, and the cage as three.js
// shows it then:
//   node rig.mjs CAGE.obj DEGREES RIG.glb POSED.obj
import { readFileSync, writeFileSync } from 'node:fs';
import { ViewedSkin } from './viewer.mjs';

const [cage, degrees, rig, posed] = process.argv.slice(2);
const lines = readFileSync(cage, 'utf8').split('\n').map((line) => line.trim().split(/\s+/));
const points = lines.filter(([kind]) => kind === 'v').map((words) => words.slice(1, 4).map(Number));
const faces = lines.filter(([kind]) => kind === 'f').map((words) => words.slice(1).map((word) => parseInt(word) - 1));
const triangles = faces.flatMap((face) => face.slice(2).map((corner, k) => [face[0], face[k + 1], corner]));

// The second joint is in the middle of the first axis; half of the cage around it follows both.
const along = points.map(([x]) => x);
const low = Math.min(...along), length = Math.max(...along) - low, middle = low + length / 2;
const shares = along.map((x) => Math.min(1, Math.max(0, 0.5 + 2 * (x - middle) / length)));
const half = Number(degrees) * Math.PI / 360;
const at = (x) => [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -x, 0, 0, 1];
const json = {
  asset: { version: '2.0' },
  scene: 0,
  scenes: [{ nodes: [0, 1] }],
  nodes: [{ mesh: 0, skin: 0 }, { name: 'upper', translation: [low, 0, 0], children: [2] },
    { name: 'lower', translation: [length / 2, 0, 0] }],
  bufferViews: [], accessors: [],
};
let binary = Buffer.alloc(0);
const add = (type, rows, Numbers = Float32Array) => {
  const data = Numbers.from(rows.flat());
  const bounds = (pick) => rows[0].map((_, k) => rows.reduce((best, row) => pick(best, row[k]), rows[0][k]));
  json.bufferViews.push({ buffer: 0, byteOffset: binary.length, byteLength: data.byteLength });
  binary = Buffer.concat([binary, Buffer.from(data.buffer), Buffer.alloc(-data.byteLength & 3)]);
  return json.accessors.push({
    bufferView: json.bufferViews.length - 1, type, count: rows.length,
    componentType: Numbers === Float32Array ? 5126 : 5123,
    ...(type === 'MAT4' ? {} : { min: bounds(Math.min), max: bounds(Math.max) }),
  }) - 1;
};
json.meshes = [{
  primitives: [{
    attributes: {
      POSITION: add('VEC3', points.map((point) => point.map(Math.fround))),
      JOINTS_0: add('VEC4', points.map(() => [0, 1, 0, 0]), Uint16Array),
      WEIGHTS_0: add('VEC4', shares.map((share) => [1 - share, share, 0, 0])),
    },
    indices: add('SCALAR', triangles.flat().map((corner) => [corner]), Uint16Array),
  }],
}];
json.skins = [{ joints: [1, 2], inverseBindMatrices: add('MAT4', [at(low), at(middle)]) }];
json.animations = [{
  channels: [{ sampler: 0, target: { node: 2, path: 'rotation' } }],
  samplers: [{
    input: add('SCALAR', [[0], [1]]),
    output: add('VEC4', [[0, 0, 0, 1], [0, 0, Math.sin(half), Math.cos(half)]]),
  }],
}];
json.buffers = [{ byteLength: binary.length }];
const text = Buffer.from(JSON.stringify(json));
const padded = Buffer.concat([text, Buffer.alloc(-text.length & 3, ' ')]);
const head = Buffer.from(Uint32Array.of(0x46546c67, 2, 28 + padded.length + binary.length, padded.length, 0x4e4f534a).buffer);
writeFileSync(rig, Buffer.concat([head, padded, Buffer.from(Uint32Array.of(binary.length, 0x004e4942).buffer), binary]));
const moved = (await ViewedSkin.read(rig)).positions(1);
writeFileSync(posed, [...moved.map((point) => `v ${point.join(' ')}`),
  ...faces.map((face) => `f ${face.map((corner) => corner + 1).join(' ')}`)].join('\n'));

// SPDX-License-Identifier: BSD-3-Clause
// Whether a .glb file is valid, and moves its model as flbc deform does:
//   node check.mjs SKIN.glb --model MODEL [--pose TIME MOVED_MODEL]... [--joints N] [--slots N]
//                  [--tolerance T] [--texture] [--turns]
// Models are .obj or .mesh; between two poses their mean is expected, unless joints turn.
import { readFileSync } from 'node:fs';
import { parseArgs } from 'node:util';
import validator from 'gltf-validator';
import { ViewedSkin } from './viewer.mjs';

// Vertices of .obj and .mesh files, as arrays of three numbers.
const wordsOf = (line) => line.trim().split(/\s+/);

function pointsOfObj(text) {
  const lines = text.split('\n').filter((line) => line.startsWith('v '));
  return lines.map((line) => wordsOf(line).slice(1, 4).map(Number));
}

function pointsOfMesh(text) {
  const lines = text.split('\n');
  const first = lines.indexOf('Vertices') + 2;
  return lines.slice(first, first + Number(lines[first - 1])).map((line) => wordsOf(line).slice(0, 3).map(Number));
}

function readPoints(path) {
  const text = readFileSync(path, 'utf8');
  const points = path.endsWith('.mesh') ? pointsOfMesh(text) : pointsOfObj(text);
  if (points.length === 0) throw new Error(`${path}: no vertices`);
  return points.map(([x, y, z = 0]) => [x, y, z]);
}

// The diagonal of the bounding box.
function sizeOf(points) {
  const extent = [0, 1, 2].map((axis) => {
    const values = points.map((point) => point[axis]);
    return values.reduce((a, b) => Math.max(a, b)) - values.reduce((a, b) => Math.min(a, b));
  });
  return Math.hypot(...extent);
}

function distance(a, b) {
  return Math.hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

function between(a, b) {
  return a.map((point, v) => point.map((x, axis) => (x + b[v][axis]) / 2));
}

function parse(argv) {
  const poses = [];
  const rest = [];
  for (let k = 0; k < argv.length; ++k) {
    if (argv[k] === '--pose') {
      poses.push({ time: Number(argv[++k]), points: readPoints(argv[++k]) });
    } else {
      rest.push(argv[k]);
    }
  }
  const { values, positionals } = parseArgs({
    args: rest,
    allowPositionals: true,
    options: {
      model: { type: 'string' },
      joints: { type: 'string' },
      slots: { type: 'string' },
      tolerance: { type: 'string', default: '1e-5' },
      texture: { type: 'boolean', default: false },
      turns: { type: 'boolean', default: false },
    },
  });
  return { ...values, poses, path: positionals[0], model: readPoints(values.model) };
}

function require(condition, message) {
  if (!condition) throw new Error(message);
}

async function validate(path, hasTexture) {
  const { issues, info } = await validator.validateBytes(new Uint8Array(readFileSync(path)));
  // Texture coordinates for which the file has no picture, and joints of a former skin, are no defects.
  const messages = issues.messages.filter(({ code, pointer }) =>
    code !== 'NODE_EMPTY' && !(hasTexture && code === 'UNUSED_OBJECT' && /TEXCOORD_0/.test(pointer)));
  require(messages.length === 0, `${path}: ${JSON.stringify(messages, null, 1)}`);
  return info;
}

// Moments and what is expected there.
function* moments({ model, poses, turns }) {
  yield { points: model };
  for (const [k, pose] of poses.entries()) {
    yield pose;
    if (turns || k + 1 === poses.length) continue;
    const next = poses[k + 1];
    yield { time: (pose.time + next.time) / 2, points: between(pose.points, next.points) };
  }
}

// The largest distance from where flbc deform puts a vertex, relative to the model's size.
function worst(skin, options) {
  const size = sizeOf(options.model);
  const sources = skin.sources();
  let largest = 0;
  for (const { time, points } of moments(options)) {
    skin.positions(time).forEach((position, v) => {
      const error = distance(position, points[sources[v]]) / size;
      largest = error <= largest ? largest : error;  // NaN stays
    });
  }
  return largest;
}

const options = parse(process.argv.slice(2));
const { path } = options;
const info = await validate(path, options.texture);
const bytes = readFileSync(path);
const { meshes, nodes } = JSON.parse(bytes.subarray(20, 20 + bytes.readUInt32LE(12)).toString());
const joints = nodes.filter(({ name }) => /^control_point_/.test(name)).length;
require(!options.joints || joints === Number(options.joints),
  `${path}: ${joints} joints, expected ${options.joints}`);
const slots = 4 * Object.keys(meshes[0].primitives[0].attributes)
  .filter((name) => name.startsWith('WEIGHTS_')).length;
require(!options.slots || slots === Number(options.slots),
  `${path}: room for ${slots} influences, expected ${options.slots}`);
require(info.animationCount === (options.poses.length > 0 ? 1 : 0), `${path}: another animation`);
const travel = Math.max(0, ...options.poses.map(({ points }) =>
  points.reduce((most, point, v) => Math.max(most, distance(point, options.model[v])), 0)));
require(options.poses.length === 0 || travel > 0, `${path}: no pose moves the model`);
// The viewer reads four influences, and no pictures outside browsers.
if (slots > 4) {
  console.log(`${path}: valid`);
} else {
  const error = worst(await ViewedSkin.read(path), options);
  require(error <= Number(options.tolerance), `${path}: ${error} of the size away from flbc deform`);
  console.log(`${path}: valid; ${error} of the size, moving by ${travel / sizeOf(options.model)}`);
}

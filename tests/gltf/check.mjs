// SPDX-License-Identifier: BSD-3-Clause
// Whether a .glb file is valid, and moves its model as flbc deform does:
//   node check.mjs SKIN.glb --model MODEL [--pose TIME MOVED_MODEL]... [--joints N] [--slots N]
//                  [--tolerance T] [--texture]
// Models are .obj or .node; between two poses their mean is expected.
import { readFileSync } from 'node:fs';
import { parseArgs } from 'node:util';
import validator from 'gltf-validator';
import { between, distance, readPoints, sizeOf } from './points.mjs';
import { SpecifiedSkin } from './skinning.mjs';
import { ViewedSkin } from './viewer.mjs';

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
    },
  });
  return { ...values, poses, path: positionals[0], model: readPoints(values.model) };
}

function require(condition, message) {
  if (!condition) throw new Error(message);
}

async function validate(path, hasTexture) {
  const { issues, info } = await validator.validateBytes(new Uint8Array(readFileSync(path)));
  // Texture coordinates for which the file has no picture are no defect.
  const messages = issues.messages.filter(
    ({ code, pointer }) => !(hasTexture && code === 'UNUSED_OBJECT' && /TEXCOORD_0/.test(pointer)));
  require(messages.length === 0, `${path}: ${JSON.stringify(messages, null, 1)}`);
  return info;
}

// Moments and what is expected there.
function* moments({ model, poses }) {
  yield { points: model };
  for (const [k, pose] of poses.entries()) {
    yield pose;
    if (k + 1 === poses.length) break;
    const next = poses[k + 1];
    yield { time: (pose.time + next.time) / 2, points: between(pose.points, next.points) };
  }
}

// The largest distance from where flbc deform puts a vertex, relative to the model's size.
function worst(skin, sources, options) {
  const size = sizeOf(options.model);
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
const specified = await SpecifiedSkin.read(path);
const sources = specified.sources();
require(!options.joints || specified.joints === Number(options.joints),
  `${path}: ${specified.joints} joints, expected ${options.joints}`);
require(!options.slots || specified.slots === Number(options.slots),
  `${path}: room for ${specified.slots} influences, expected ${options.slots}`);
require(info.animationCount === (options.poses.length > 0 ? 1 : 0), `${path}: another animation`);
const travel = Math.max(0, ...options.poses.map(({ points }) =>
  points.reduce((most, point, v) => Math.max(most, distance(point, options.model[v])), 0)));
require(options.poses.length === 0 || travel > 0, `${path}: no pose moves the model`);

const errors = { specification: worst(specified, sources, options) };
if (specified.slots === 4) errors.viewer = worst(await ViewedSkin.read(path), sources, options);
for (const [name, error] of Object.entries(errors)) {
  require(error <= Number(options.tolerance),
    `${path}: ${name}: ${error} of the model's size away from flbc deform`);
}
console.log(`${path}: valid; ${JSON.stringify(errors)} of the size, moving by ` +
  `${(travel / sizeOf(options.model)).toPrecision(3)}`);

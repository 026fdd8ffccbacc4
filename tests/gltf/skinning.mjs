// SPDX-License-Identifier: BSD-3-Clause
// Skinning as the specification of glTF 2.0 defines it, with all sets of influences, in double
// precision. Only reading the file is left to a library.
import { NodeIO } from '@gltf-transform/core';

// Matrices are column-major, as glTF has them.
function multiply(a, b) {
  const product = new Array(16).fill(0);
  for (let row = 0; row < 4; ++row) {
    for (let column = 0; column < 4; ++column) {
      for (let k = 0; k < 4; ++k) product[4 * column + row] += a[4 * k + row] * b[4 * column + k];
    }
  }
  return product;
}

function transform(m, [x, y, z]) {
  return [0, 1, 2].map((row) => m[row] * x + m[4 + row] * y + m[8 + row] * z + m[12 + row]);
}

// LINEAR, and constant before the first and after the last key.
function sample(sampler, time) {
  if (sampler.getInterpolation() !== 'LINEAR') throw new Error('expected LINEAR interpolation');
  const times = sampler.getInput().getArray();
  const value = (k) => sampler.getOutput().getElement(k, []);
  let next = times.findIndex((t) => t > time);
  if (next === 0) return value(0);
  if (next < 0) return value(times.length - 1);
  const part = (time - times[next - 1]) / (times[next] - times[next - 1]);
  const [before, after] = [value(next - 1), value(next)];
  return before.map((x, axis) => x + part * (after[axis] - x));
}

function setPose(root, time) {
  for (const channel of root.listAnimations().flatMap((animation) => animation.listChannels())) {
    if (channel.getTargetPath() !== 'translation') throw new Error('a joint does more than move');
    channel.getTargetNode().setTranslation(sample(channel.getSampler(), time));
  }
}

function globalMatrix(node) {
  const parent = node.getParentNode();
  return parent ? multiply(globalMatrix(parent), node.getMatrix()) : node.getMatrix();
}

export class SpecifiedSkin {
  static async read(path) {
    const skin = new SpecifiedSkin();
    skin.root = (await new NodeIO().read(path)).getRoot();
    const node = skin.root.listNodes().find((candidate) => candidate.getSkin());
    skin.skin = node.getSkin();
    skin.primitive = node.getMesh().listPrimitives()[0];
    return skin;
  }

  // The number of influence slots per vertex.
  get slots() {
    return this.primitive.getAttribute('JOINTS_1') ? 8 : 4;
  }

  // The number of control points.
  get joints() {
    return this.skin.listJoints().filter((joint) => /^control_point_/.test(joint.getName())).length;
  }

  // Which vertex of the model each one is.
  sources() {
    const count = this.primitive.getAttribute('POSITION').getCount();
    const numbers = this.primitive.getAttribute('_VERTEX');
    return Array.from({ length: count }, (_, v) => (numbers ? numbers.getScalar(v) : v));
  }

  // At rest if no time is given.
  positions(time) {
    if (time !== undefined) setPose(this.root, time);
    const inverseBinds = this.skin.getInverseBindMatrices();
    const matrices = this.skin.listJoints().map((joint, i) =>
      multiply(globalMatrix(joint), inverseBinds.getElement(i, [])));
    const attribute = (name, v) => this.primitive.getAttribute(name).getElement(v, []);
    return this.sources().map((_, v) => {
      const position = attribute('POSITION', v);
      const result = [0, 0, 0];
      for (let set = 0; set < this.slots / 4; ++set) {
        const weights = attribute(`WEIGHTS_${set}`, v);
        attribute(`JOINTS_${set}`, v).forEach((joint, k) => {
          const moved = transform(matrices[joint], position);
          for (let axis = 0; axis < 3; ++axis) result[axis] += weights[k] * moved[axis];
        });
      }
      return result;
    });
  }
}

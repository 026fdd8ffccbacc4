// SPDX-License-Identifier: BSD-3-Clause
// Moves the model's points with the cage: where they are at rest, and the weighted sum of how far
// the control points are from there. Every point is computed anew from these, never from where it
// was before, so that the same cage always gives the same bits.

const kInfluence = 1e-4;  // smaller weights count as none

export class Deformer {
  constructor(weights, base, rest) {
    this.weights = weights;
    this.base = base;
    this.rest = rest;
    this.moved = Float32Array.from(base);
    this.steps = new Float64Array(rest.length);
    this.isStale = false;
  }

  // Takes the control points to places in a flat array.
  move(controlPoints) {
    const { rest, steps } = this;
    for (let k = 0; k < steps.length; ++k) steps[k] = controlPoints[k] - rest[k];
    this.isStale = true;
  }

  // Where the points are now. They are computed when they are asked for: of large models only the
  // card needs them.
  get points() {
    if (this.isStale) this.update();
    return this.moved;
  }

  update() {
    const { starts, controlPoints: owners, values } = this.weights;
    const { base, moved: points, steps } = this;
    this.isStale = false;
    for (let p = 0; p < starts.length - 1; ++p) {
      let x = base[3 * p], y = base[3 * p + 1], z = base[3 * p + 2];
      for (let k = starts[p]; k < starts[p + 1]; ++k) {
        const weight = values[k], owner = 3 * owners[k];
        x += weight * steps[owner];
        y += weight * steps[owner + 1];
        z += weight * steps[owner + 2];
      }
      points[3 * p] = x;
      points[3 * p + 1] = y;
      points[3 * p + 2] = z;
    }
  }

  // How far every point is from where it rests.
  displacements() {
    const { base, points } = this;
    const step = (k) => points[k] - base[k];
    return Float32Array.from({ length: points.length / 3 }, (_, p) => Math.hypot(step(3 * p), step(3 * p + 1), step(3 * p + 2)));
  }

  // The sum of the weights of some control points, at every point.
  weightsOf(selection) {
    const { starts, controlPoints: owners, values } = this.weights;
    const isSelected = new Uint8Array(this.rest.length / 3);
    for (const i of selection) isSelected[i] = 1;
    const sums = new Float32Array(starts.length - 1);
    for (let p = 0; p < sums.length; ++p) {
      for (let k = starts[p]; k < starts[p + 1]; ++k) sums[p] += isSelected[owners[k]] * values[k];
    }
    return sums;
  }

  // The weights of a mean of points, by control point. \param shares  points with their shares
  weightsAt(shares) {
    const { starts, controlPoints: owners, values } = this.weights;
    const result = new Map();
    for (const [p, share] of shares) {
      for (let k = starts[p]; k < starts[p + 1]; ++k) result.set(owners[k], (result.get(owners[k]) ?? 0) + share * values[k]);
    }
    return result;
  }

  // How many of the model's points control points move.
  countMovedBy(indices) {
    const { weights, moving } = this, key = indices.join();
    if (moving?.weights !== weights || moving.key !== key) {
      this.moving = { weights, key, count: this.weightsOf(indices).filter((sum) => sum > kInfluence).length };
    }
    return this.moving.count;
  }

  // Eight weights per point for the card, and their control points; null if a point has more.
  weightsForCard() {
    const { starts, controlPoints: owners, values } = this.weights;
    const count = starts.length - 1;
    const indices = new Uint16Array(8 * count), weights = new Float32Array(8 * count);
    for (let p = 0; p < count; ++p) {
      if (starts[p + 1] - starts[p] > 8) return null;
      for (let k = starts[p]; k < starts[p + 1]; ++k) {
        indices[8 * p + k - starts[p]] = owners[k];
        weights[8 * p + k - starts[p]] = values[k];
      }
    }
    return { indices, weights };
  }

  influenceCounts() {
    const { starts } = this.weights;
    return Float32Array.from({ length: starts.length - 1 }, (_, p) => starts[p + 1] - starts[p]);
  }
}

// SPDX-License-Identifier: BSD-3-Clause
// From where the model is looked at. In the plane nothing turns.
import { add, boundingSphere, cross, dot, length, pointAt, subtract, times } from "./vectors.mjs";

const kSteepest = 1.55;  // radians: a view from above still knows where right is
const kPerspective = 0.27;  // tangent of half of the vertical field of view
const kMargin = 1.12;

// Right, up and toward a viewer in front of a model on which this axis points up.
export const kBases = [[[0, -1, 0], [1, 0, 0], [0, 0, 1]], [[1, 0, 0], [0, 1, 0], [0, 0, 1]],
                [[1, 0, 0], [0, 0, 1], [0, -1, 0]]];

export class Camera {
  // \param up  axis, 0 to 2 \param front  azimuth of the front in degrees
  constructor(dim, up = 1, front = 0) {
    this.dim = dim;
    const [right, above, toward] = kBases[up];
    const [x, z] = [Math.cos(front * Math.PI / 180), Math.sin(front * Math.PI / 180)].map(Math.round);
    this.basis = [add(times(x, right), times(-z, toward)), above, add(times(z, right), times(x, toward))];
    this.yaw = dim === 3 ? 0.6 : 0;
    this.pitch = dim === 3 ? 0.3 : 0;
    this.target = [0, 0, 0];
    this.halfHeight = 1;  // of what is seen at the target
    this.sphere = { center: [0, 0, 0], radius: 1 };  // in which everything lies
    this.width = 1;
    this.height = 1;
  }

  // Right, up and toward the eye.
  axes() {
    const toward = this.inModel(this.direction());
    const right = this.inModel([Math.cos(this.yaw), 0, -Math.sin(this.yaw)]);
    return { right, up: cross(toward, right), toward };
  }

  // Toward the eye, in the basis.
  direction() {
    return [Math.cos(this.pitch) * Math.sin(this.yaw), Math.sin(this.pitch), Math.cos(this.pitch) * Math.cos(this.yaw)];
  }

  inModel(place) {
    const [right, up, front] = this.basis;
    return add(add(times(place[0], right), times(place[1], up)), times(place[2], front));
  }

  // Turns the model by 90 degrees around the axis nearest to the direction of view.
  turn() {
    if (this.dim === 2) return;
    const direction = this.direction();
    const sizes = direction.map(Math.abs);
    const axis = sizes.indexOf(Math.max(...sizes));
    const sign = Math.sign(direction[axis]);
    const i = (axis + 1) % 3, j = (axis + 2) % 3;
    const turned = [...this.basis];
    turned[i] = times(sign, this.basis[j]);
    turned[j] = times(-sign, this.basis[i]);
    this.basis = turned;
  }

  // By how much things shrink with their distance, per unit of length.
  shrinking() {
    return this.dim === 3 ? kPerspective / this.halfHeight : 0;
  }

  // How much smaller than at the target a thing at `place` appears.
  depthFactor(place) {
    const { toward } = this.axes();
    return Math.max(1e-3, 1 - this.shrinking() * dot(toward, subtract(place, this.target)));
  }

  // From places seen from `origin` to clip coordinates, column by column. What is nearer has the
  // smaller depth.
  matrix(origin) {
    const { right, up, toward } = this.axes();
    const shrinking = this.shrinking();
    const reach = length(subtract(this.sphere.center, this.target)) + 1.5 * this.sphere.radius;
    const near = shrinking > 0 ? Math.min(reach, 0.98 / shrinking) : reach;
    const far = -reach;
    const nearFactor = 1 - shrinking * near, farFactor = 1 - shrinking * far;
    const slope = (nearFactor + farFactor) / (far - near);
    const offset = -nearFactor - slope * near;
    const rows = [times(this.height / (this.width * this.halfHeight), right),
                  times(1 / this.halfHeight, up), times(slope, toward), times(-shrinking, toward)];
    const offsets = [0, 0, offset, 1];
    const result = new Float32Array(16);
    rows.forEach((row, r) => {
      for (let c = 0; c < 3; ++c) result[4 * c + r] = row[c];
      result[12 + r] = offsets[r] - dot(row, subtract(this.target, origin));
    });
    return result;
  }

  // Where a place appears, in pixels from the upper left corner, and how near it is.
  project(place) {
    const { right, up, toward } = this.axes();
    const offset = subtract(place, this.target);
    const scale = this.height / (2 * this.halfHeight * this.depthFactor(place));
    return { x: this.width / 2 + scale * dot(right, offset),
             y: this.height / 2 - scale * dot(up, offset), nearness: dot(toward, offset) };
  }

  // The step in the picture's plane that moves a thing at `place` by so many pixels.
  step(place, dx, dy) {
    const { right, up } = this.axes();
    const unit = 2 * this.halfHeight * this.depthFactor(place) / this.height;
    return add(times(unit * dx, right), times(-unit * dy, up));
  }

  orbit(dx, dy) {
    if (this.dim === 2) return;
    this.yaw -= 0.008 * dx;
    this.pitch = Math.max(-kSteepest, Math.min(kSteepest, this.pitch + 0.008 * dy));
  }

  pan(dx, dy) {
    this.target = subtract(this.target, this.step(this.target, dx, dy));
  }

  // The point under (x, y) stays there.
  zoom(factor, x, y) {
    const before = this.step(this.target, x - this.width / 2, y - this.height / 2);
    const smallest = 1e-4 * this.sphere.radius, largest = 1e2 * this.sphere.radius;
    const halfHeight = Math.max(smallest, Math.min(largest, this.halfHeight / factor));
    this.target = add(this.target, times(1 - halfHeight / this.halfHeight, before));
    this.halfHeight = halfHeight;
  }

  look(yaw, pitch) {
    this.yaw = yaw;
    this.pitch = pitch;
  }

  // Shows all of the points as large as possible.
  frame(points) {
    const { center, radius } = boundingSphere(points);
    this.target = center;
    const { right, up, toward } = this.axes();
    const perspective = this.dim === 3 ? kPerspective : 0;
    let wanted = 0.02 * radius;
    for (let i = 0; i < points.length / 3; ++i) {
      const offset = times(kMargin, subtract(pointAt(points, i), center));
      const extent = Math.max(Math.abs(dot(up, offset)), Math.abs(dot(right, offset)) * this.height / this.width);
      // Nearer points than the target appear larger.
      wanted = Math.max(wanted, extent + perspective * dot(toward, offset));
    }
    this.halfHeight = wanted;
  }
}

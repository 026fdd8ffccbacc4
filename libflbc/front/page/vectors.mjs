// SPDX-License-Identifier: BSD-3-Clause
// Vectors of three numbers, and points that lie one after the other in a flat array.

export function dot(a, b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

export function cross(a, b) {
  return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
}

export function add(a, b) {
  return [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
}

export function subtract(a, b) {
  return [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
}

export function times(factor, a) {
  return [factor * a[0], factor * a[1], factor * a[2]];
}

export function length(a) {
  return Math.hypot(a[0], a[1], a[2]);
}

// Point i of a flat array.
export function pointAt(points, i) {
  return [points[3 * i], points[3 * i + 1], points[3 * i + 2]];
}

export function setPoint(points, i, place) {
  points[3 * i] = place[0];
  points[3 * i + 1] = place[1];
  points[3 * i + 2] = place[2];
}

// The mean of some points.
export function centroid(points, indices) {
  let sum = [0, 0, 0];
  for (const i of indices) sum = add(sum, pointAt(points, i));
  return times(1 / Math.max(1, indices.length), sum);
}

// The smallest box round points, as its middle and half of its diagonal.
export function boundingSphere(points) {
  const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
  for (let k = 0; k < points.length; ++k) {
    low[k % 3] = Math.min(low[k % 3], points[k]);
    high[k % 3] = Math.max(high[k % 3], points[k]);
  }
  if (points.length === 0) return { center: [0, 0, 0], radius: 1 };
  return { center: times(0.5, add(low, high)), radius: length(subtract(high, low)) / 2 || 1 };
}

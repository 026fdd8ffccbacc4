// SPDX-License-Identifier: BSD-3-Clause
// Which control points lie under the pointer or in an outline.
import { add, pointAt } from "./vectors.mjs";

const kSame = 4;  // pixels within which the nearer one to the eye counts

// \return -1 if there is none within reach
export function pick(points, camera, x, y, reach) {
  let best = -1, bestDistance = Infinity, bestNearness = -Infinity;
  for (let i = 0; i < points.length / 3; ++i) {
    const spot = camera.project(pointAt(points, i));
    const distance = Math.hypot(spot.x - x, spot.y - y);
    if (distance > reach) continue;
    const isBetter = Math.abs(distance - bestDistance) < kSame ? spot.nearness > bestNearness : distance < bestDistance;
    if (!isBetter) continue;
    best = i;
    bestDistance = distance;
    bestNearness = spot.nearness;
  }
  return best;
}

export function rectangle(from, to) {
  return [from, { x: to.x, y: from.y }, to, { x: from.x, y: to.y }];
}

// Whether a place lies in a closed outline of corners.
export function isInside(outline, { x, y }) {
  let result = false;
  outline.forEach((a, k) => {
    const b = outline[(k + 1) % outline.length];
    if (a.y > y !== b.y > y && x < a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x)) result = !result;
  });
  return result;
}

export function pointsInside(points, camera, outline) {
  const found = [];
  for (let i = 0; i < points.length / 3; ++i) {
    if (isInside(outline, camera.project(pointAt(points, i)))) found.push(i);
  }
  return found;
}

// The front of a surface under a place of the picture, and the points of its triangle with their shares.
// \param points  seen from `center` \return null where there is none
export function surfaceAt(points, { triangles, sources }, camera, center, { x, y }) {
  const m = camera.matrix(center);
  const right = 2 * x / camera.width - 1, up = 1 - 2 * y / camera.height;
  // In clip coordinates, from the line of sight.
  const seen = Float64Array.from({ length: 4 * points.length / 3 });
  for (let p = 0; p < points.length / 3; ++p) {
    for (let r = 0; r < 4; ++r) seen[4 * p + r] = m[r] * points[3 * p] + m[4 + r] * points[3 * p + 1] + m[8 + r] * points[3 * p + 2] + m[12 + r];
    seen[4 * p] -= right * seen[4 * p + 3];
    seen[4 * p + 1] -= up * seen[4 * p + 3];
  }
  const source = (corner) => (sources ? sources[corner] : corner);
  let found = null, depth = Infinity;
  for (let t = 0; t < triangles.length; t += 3) {
    const a = source(triangles[t]), b = source(triangles[t + 1]), c = source(triangles[t + 2]);
    const area = (i, j) => seen[4 * i] * seen[4 * j + 1] - seen[4 * i + 1] * seen[4 * j];
    const u = area(b, c), v = area(c, a), w = area(a, b), sum = u + v + w;
    if (sum === 0 || u * sum < 0 || v * sum < 0 || w * sum < 0) continue;
    const mean = (values, width, k) => (u * values[width * a + k] + v * values[width * b + k] + w * values[width * c + k]) / sum;
    const far = mean(seen, 4, 2) / mean(seen, 4, 3);
    if (mean(seen, 4, 3) <= 0 || far >= depth) continue;
    depth = far;
    found = { place: add(center, [0, 1, 2].map((k) => mean(points, 3, k))), shares: [[a, u / sum], [b, v / sum], [c, w / sum]] };
  }
  return found;
}

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
  const count = points.length / 3, [xs, ys, depths, ws] = Array.from({ length: 4 }, () => new Float64Array(count));
  for (let p = 0; p < count; ++p) {
    const a = points[3 * p], b = points[3 * p + 1], c = points[3 * p + 2];
    const w = m[3] * a + m[7] * b + m[11] * c + m[15];
    xs[p] = m[0] * a + m[4] * b + m[8] * c + m[12] - right * w;
    ys[p] = m[1] * a + m[5] * b + m[9] * c + m[13] - up * w;
    depths[p] = m[2] * a + m[6] * b + m[10] * c + m[14];
    ws[p] = w;
  }
  let found = null, nearest = Infinity;
  for (let t = 0; t < triangles.length; t += 3) {
    let a = triangles[t], b = triangles[t + 1], c = triangles[t + 2];
    if (sources) [a, b, c] = [sources[a], sources[b], sources[c]];
    const u = xs[b] * ys[c] - xs[c] * ys[b], v = xs[c] * ys[a] - xs[a] * ys[c], w = xs[a] * ys[b] - xs[b] * ys[a];
    const sum = u + v + w;
    if (sum === 0 || u * sum < 0 || v * sum < 0 || w * sum < 0) continue;
    const mean = (values, width = 1, k = 0) => (u * values[width * a + k] + v * values[width * b + k] + w * values[width * c + k]) / sum;
    const depth = mean(depths) / mean(ws);
    if (mean(ws) <= 0 || depth >= nearest) continue;
    nearest = depth;
    found = { place: add(center, [0, 1, 2].map((k) => mean(points, 3, k))), shares: [[a, u / sum], [b, v / sum], [c, w / sum]] };
  }
  return found;
}

// SPDX-License-Identifier: BSD-3-Clause
// Which control points lie under the pointer or in an outline.
import { pointAt } from "./vectors.mjs";

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

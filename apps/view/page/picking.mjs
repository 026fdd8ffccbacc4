// SPDX-License-Identifier: BSD-3-Clause
// Which control points lie under the pointer or in a rectangle.
import { pointAt } from "./vectors.mjs";

const kSame = 4;  // pixels within which the nearer one to the eye counts

// \return -1 if there is none within reach
export function pick(points, camera, x, y, reach) {
  let best = -1, bestDistance = Infinity, bestNearness = -Infinity;
  for (let i = 0; i < points.length / 3; ++i) {
    const spot = camera.project(pointAt(points, i));
    const distance = Math.hypot(spot.x - x, spot.y - y);
    if (distance > reach) continue;
    const isBetter = Math.abs(distance - bestDistance) < kSame ? spot.nearness > bestNearness
                                                              : distance < bestDistance;
    if (!isBetter) continue;
    best = i;
    bestDistance = distance;
    bestNearness = spot.nearness;
  }
  return best;
}

export function pointsInRectangle(points, camera, from, to) {
  const [left, right] = [Math.min(from.x, to.x), Math.max(from.x, to.x)];
  const [top, bottom] = [Math.min(from.y, to.y), Math.max(from.y, to.y)];
  const found = [];
  for (let i = 0; i < points.length / 3; ++i) {
    const { x, y } = camera.project(pointAt(points, i));
    if (x >= left && x <= right && y >= top && y <= bottom) found.push(i);
  }
  return found;
}

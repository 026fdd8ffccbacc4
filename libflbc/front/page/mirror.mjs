// SPDX-License-Identifier: BSD-3-Clause
// Which control points are mirror images of each other at rest, and moving them alike.

const kTolerance = 1e-2;  // of the cage's size

function reflected(points, i, axis, plane) {
  const place = [points[3 * i], points[3 * i + 1], points[3 * i + 2]];
  place[axis] = 2 * plane - place[axis];
  return place;
}

// For every point its image at the plane, -1 where there is none; images of each other only.
function pairsAt(points, axis, plane, tolerance) {
  const count = points.length / 3;
  const nearest = new Int32Array(count).fill(-1);
  for (let i = 0; i < count; ++i) {
    const [x, y, z] = reflected(points, i, axis, plane);
    let least = tolerance;
    for (let j = 0; j < count; ++j) {
      const distance = Math.hypot(points[3 * j] - x, points[3 * j + 1] - y, points[3 * j + 2] - z);
      if (distance < least) {
        least = distance;
        nearest[i] = j;
      }
    }
  }
  return nearest.map((j, i) => (j >= 0 && nearest[j] === i ? j : -1));
}

// At the plane, of those through the given places, that has most pairs.
export function mirrorPairs(points, axis, size, places) {
  let best = null, most = -1;
  for (const plane of places) {
    const pairs = pairsAt(points, axis, plane, kTolerance * size);
    const count = pairs.reduce((sum, j) => sum + (j >= 0), 0);
    if (count > most) {
      most = count;
      best = pairs;
    }
  }
  return best;
}

// Moves the images of the points listed as these moved from where they started. Points on the
// plane stay in it; a point and its image that are both listed have moved already.
export function mirrorMoves(start, result, indices, pairs, axis) {
  const listed = new Set(indices);
  for (const i of indices) {
    const j = pairs[i];
    if (j === i) result[3 * i + axis] = start[3 * i + axis];
    if (j < 0 || listed.has(j)) continue;
    for (let k = 0; k < 3; ++k) {
      const step = result[3 * i + k] - start[3 * i + k];
      result[3 * j + k] = start[3 * j + k] + (k === axis ? -step : step);
    }
  }
}

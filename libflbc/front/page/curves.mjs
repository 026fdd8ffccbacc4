// SPDX-License-Identifier: BSD-3-Clause
// Curved edges of cages in 2D: cubic Bezier curves, whose handles are control points after the corners.

// Corner, two handles, and corner of each curve. \param count  of all control points, of which a third are corners
export function curvesOf(facets, count) {
  const corners = count / 3, cornerAt = new Map();
  for (let f = 0; f < facets.length; f += 2) {
    const [low, high] = [facets[f], facets[f + 1]].sort((a, b) => a - b);
    if (low < corners) cornerAt.set(high, low);
  }
  return Array.from({ length: corners }, (_, e) => {
    const handle = corners + 2 * e;
    return [cornerAt.get(handle), handle, handle + 1, cornerAt.get(handle + 1)];
  });
}

// The share of each of these four at a place of the curve, from 0 to 1.
export function bernstein(t) {
  const s = 1 - t;
  return [s * s * s, 3 * t * s * s, 3 * t * t * s, t * t * t];
}

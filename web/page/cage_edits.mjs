// SPDX-License-Identifier: BSD-3-Clause
// More and fewer control points: cages as points, `dim` numbers each, and facets, `dim` indices each.
// Edited ones also have `numbers`, the new index of each control point of before, or undefined.
import { bernstein, curvesOf } from "../../libflbc/front/page/curves.mjs";
import { poseText } from "../../libflbc/front/page/obj.mjs";

const kStraight = 8;  // edges of the cage that is solved, for each curve

function facetsOf(facets, dim) {
  return Array.from({ length: facets.length / dim }, (_, f) => [...facets.slice(dim * f, dim * f + dim)]);
}

// A control point in the middle of the edge between two. \return null if there is no such edge
export function splitEdge({ points, facets, dim }, [a, b]) {
  const middle = points.length / dim;
  const isOn = (facet) => facet.includes(a) && facet.includes(b);
  const all = facetsOf(facets, dim);
  if (!all.some(isOn)) return null;
  const replaced = (facet, old) => facet.map((i) => (i === old ? middle : i));
  const place = Array.from({ length: dim }, (_, k) => (points[dim * a + k] + points[dim * b + k]) / 2);
  return { dim, points: [...points, ...place], numbers: [...Array(middle).keys()],
           facets: all.flatMap((facet) => (isOn(facet) ? [replaced(facet, b), replaced(facet, a)] : [facet])).flat() };
}

// One control point in the middle of several.
export function mergePoints({ points, facets, dim }, merged) {
  const count = points.length / dim;
  const middle = Array.from({ length: dim }, (_, k) =>
    merged.reduce((sum, i) => sum + points[dim * i + k], 0) / merged.length);
  const target = Array.from({ length: count }, (_, i) => (merged.includes(i) ? merged[0] : i));
  const left = facetsOf(facets, dim).map((facet) => facet.map((i) => target[i]))
    .filter((facet) => new Set(facet).size === dim);
  const kept = [...Array(count).keys()].filter((i) => target[i] === i && left.some((facet) => facet.includes(i)));
  const number = new Map(kept.map((i, k) => [i, k]));
  return { dim, facets: left.flat().map((i) => number.get(i)), numbers: target.map((i) => number.get(i)),
           points: kept.flatMap((i) => (i === merged[0] ? middle : [...points.slice(dim * i, dim * i + dim)])) };
}

export function cageToObj({ points, facets, dim }) {
  return poseText("", null, points, dim, facets);
}

// A cage in 2D whose edges become curves, by two handles each in their thirds, which come after the corners.
export function curvedCage({ points, facets }) {
  const corners = points.length / 2, handles = [], outline = [];
  facetsOf(facets, 2).forEach(([a, b], e) => {
    const handle = corners + 2 * e;
    for (const share of [1 / 3, 2 / 3]) for (const k of [0, 1]) handles.push(points[2 * a + k] + share * (points[2 * b + k] - points[2 * a + k]));
    outline.push(a, handle, handle, handle + 1, handle + 1, b);
  });
  return { points: [...points, ...handles], facets: outline };
}

// Its corners alone.
export function straightCage({ points, facets }) {
  return { points: points.slice(0, points.length / 3), facets: curvesOf(facets, points.length / 2).flatMap(([a, , , b]) => [a, b]) };
}

// What is solved for a curved cage: corners and straight pieces between them, and their weights for corners and handles.
export function piecesOf({ points, facets }) {
  const corners = points.length / 6, rows = Array.from({ length: corners }, (_, i) => [[i, 1]]), pieces = [];
  for (const curve of curvesOf(facets, points.length / 2)) {
    pieces.push(curve[0]);
    for (let k = 1; k < kStraight; ++k) {
      pieces.push(rows.length, rows.length);
      const shares = bernstein(k / kStraight);
      rows.push(curve.map((i, m) => [i, shares[m]]).sort(([a], [b]) => a - b));
    }
    pieces.push(curve[3]);
  }
  const place = (row) => [0, 1].map((k) => row.reduce((sum, [i, share]) => sum + share * points[2 * i + k], 0));
  const starts = [0];
  for (const row of rows) starts.push(starts.at(-1) + row.length);
  return { cage: { points: rows.flatMap(place), facets: pieces },
           map: { starts, controlPoints: rows.flat().map(([i]) => i), values: rows.flat().map(([, share]) => share) } };
}

// SPDX-License-Identifier: BSD-3-Clause
// More and fewer control points: cages as points, `dim` numbers each, and facets, `dim` indices each.
// Edited ones also have `numbers`, the new index of each control point of before, or undefined.
import { poseText } from "../../libflbc/front/page/obj.mjs";

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

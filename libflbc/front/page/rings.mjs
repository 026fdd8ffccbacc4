// SPDX-License-Identifier: BSD-3-Clause
// Groups of control points on a cage: the ring around a limb, what lies beyond it, and neighbors.
import { sumNormals } from "./surface_normals.mjs";
import { add, cross, dot, length, pointAt, subtract, times } from "./vectors.mjs";

const kPlanes = 36;   // that are tried for the shortest section
const kDetour = 1.5;  // along the outline, times the way across, to a point on the other side

export class CageGraph {
  constructor(facets, dim, count) {
    this.facets = facets;
    this.dim = dim;
    this.neighbors = Array.from({ length: count }, () => new Set());
    this.facetsAt = new Map();  // of two control points, in both orders
    for (let f = 0; f < facets.length; f += dim) {
      for (let k = 0; k < dim; ++k) {
        const a = facets[f + k], b = facets[f + (k + 1) % dim];
        this.neighbors[a].add(b);
        this.neighbors[b].add(a);
        for (const key of [`${a} ${b}`, `${b} ${a}`]) {
          this.facetsAt.set(key, [...(this.facetsAt.get(key) ?? []), f]);
        }
      }
    }
  }

  grow(selection) {
    return [...selection, ...[...selection].flatMap((i) => [...this.neighbors[i]])];
  }

  shrink(selection) {
    return [...selection].filter((i) => [...this.neighbors[i]].every((j) => selection.has(j)));
  }

  // The selection and everything that it separates from the largest part of the cage.
  beyond(selection) {
    const parts = [];
    const seen = new Set(selection);
    for (let i = 0; i < this.neighbors.length; ++i) {
      if (seen.has(i)) continue;
      const part = [i];
      seen.add(i);
      for (const j of part) {
        for (const k of this.neighbors[j]) if (!seen.has(k)) part.push(k), seen.add(k);
      }
      parts.push(part);
    }
    parts.sort((a, b) => b.length - a.length);
    return [...selection, ...parts.slice(1).flat()];
  }

  // Lengths of the shortest paths along edges; only those up to `limit` are sure to be in the map.
  distances(points, sources, limit = Infinity) {
    const distances = new Map([...sources].map((i) => [i, 0]));
    const open = new Set(distances.keys());
    while (open.size > 0) {
      const [i] = open;
      open.delete(i);
      for (const j of this.neighbors[i]) {
        const through = distances.get(i) + length(subtract(pointAt(points, j), pointAt(points, i)));
        if (through > limit || through >= (distances.get(j) ?? Infinity)) continue;
        distances.set(j, through);
        open.add(j);
      }
    }
    return distances;
  }

  // The control points around the limb at point v: those nearest to the shortest section.
  ring(points, v) {
    return this.dim === 2 ? this.pairAcross(points, v) : this.shortestSection(points, v);
  }

  // In the plane, v and the point across the limb. At the tip of a limb there is none: what is across
  // has another point much nearer across.
  pairAcross(points, v) {
    const [j, far] = this.across(points, v);
    return j !== undefined && far <= 2 * this.across(points, j)[1] ? [v, j] : [v];
  }

  // The nearest point across the shape, one that is farther along the outline, and its distance.
  across(points, v) {
    const paths = this.distances(points, [v]);
    const far = (j) => length(subtract(pointAt(points, j), pointAt(points, v)));
    const crosses = (j) => [1, 2, 3, 4, 5, 6, 7].every((k) => this.encloses(points, v, j, k / 8));
    const others = this.neighbors.map((_, j) => j)
      .filter((j) => j !== v && !(paths.get(j) < kDetour * far(j)) && crosses(j));
    const [nearest] = others.sort((a, b) => far(a) - far(b));
    return nearest === undefined ? [undefined, Infinity] : [nearest, far(nearest)];
  }

  // Whether a place between two points lies inside the outline.
  encloses(points, v, j, share) {
    const [x, y] = add(times(1 - share, pointAt(points, v)), times(share, pointAt(points, j)));
    let isInside = false;
    for (let f = 0; f < this.facets.length; f += 2) {
      const a = pointAt(points, this.facets[f]), b = pointAt(points, this.facets[f + 1]);
      if ((a[1] > y) !== (b[1] > y) && x < a[0] + (y - a[1]) / (b[1] - a[1]) * (b[0] - a[0])) isInside = !isInside;
    }
    return isInside;
  }

  // Of the planes that contain the normal at v.
  shortestSection(points, v) {
    const normals = new Float64Array(points.length);
    sumNormals(points, this.facets, null, normals);
    const normal = pointAt(normals, v);
    const sizes = normal.map(Math.abs);
    const axis = sizes.indexOf(Math.min(...sizes));
    const first = cross(normal, [0, 1, 2].map((k) => (k === axis ? 1 : 0)));
    const second = times(1 / (length(normal) || 1), cross(normal, first));
    let best = { perimeter: Infinity, ring: [v] };
    for (let k = 0; k < kPlanes; ++k) {
      const angle = Math.PI * k / kPlanes;
      const across = add(times(Math.cos(angle), first), times(Math.sin(angle), second));
      const section = this.section(points, v, across);
      if (section && section.perimeter < best.perimeter) best = section;
    }
    return best.ring;
  }

  // Walks along the section of the cage with the plane through v, from facet to facet.
  section(points, v, across) {
    const origin = pointAt(points, v);
    const height = (i) => dot(across, subtract(pointAt(points, i), origin));
    const isCut = ([a, b]) => height(a) >= 0 !== height(b) >= 0;
    const cutEdges = (f) => [0, 1, 2].map((k) => [this.facets[f + k], this.facets[f + (k + 1) % 3]]).filter(isCut);
    const below = [...this.neighbors[v]].find((i) => height(i) < 0);
    if (below === undefined) return null;
    let edge = [v, below], [facet] = this.facetsAt.get(edge.join(" "));
    let from = origin, perimeter = 0;
    const start = facet, ring = new Set();
    for (let steps = 0; facet !== undefined && steps < this.facets.length; ++steps) {
      const [a, b] = edge;
      const share = height(a) / (height(a) - height(b));
      const to = add(times(1 - share, pointAt(points, a)), times(share, pointAt(points, b)));
      perimeter += length(subtract(to, from));
      from = to;
      ring.add(share < 0.5 ? a : b);
      edge = cutEdges(facet).find((other) => !edge.every((i) => other.includes(i)));
      facet = this.facetsAt.get(edge.join(" ")).find((f) => f !== facet);
      if (facet !== start) continue;
      perimeter += length(subtract(origin, from));
      return ring.size > 2 ? { perimeter, ring: [...ring] } : null;
    }
    return null;  // the cage has a border there
  }
}

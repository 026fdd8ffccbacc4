// SPDX-License-Identifier: BSD-3-Clause
// Vertices of triangles: copies of the model's points, with normals that follow them.

// Per vertex the numbers of its point, `size` of them.
export function atVertices(ofPoints, sources, size, result) {
  if (!sources) return ofPoints;
  for (let v = 0; v < sources.length; ++v) {
    for (let k = 0; k < size; ++k) result[size * v + k] = ofPoints[size * sources[v] + k];
  }
  return result;
}

// Sums of the triangles' normals, longer for larger ones. Vertices of one group, which have one
// place, share theirs.
export function sumNormals(positions, triangles, groups, normals) {
  normals.fill(0);
  const group = (v) => (groups ? groups[v] : v);
  for (let t = 0; t < triangles.length; t += 3) {
    const a = 3 * triangles[t], b = 3 * triangles[t + 1], c = 3 * triangles[t + 2];
    const ax = positions[a], ay = positions[a + 1], az = positions[a + 2];
    const ux = positions[b] - ax, uy = positions[b + 1] - ay, uz = positions[b + 2] - az;
    const vx = positions[c] - ax, vy = positions[c + 1] - ay, vz = positions[c + 2] - az;
    const x = uy * vz - uz * vy, y = uz * vx - ux * vz, z = ux * vy - uy * vx;
    for (let k = 0; k < 3; ++k) {
      const n = 3 * group(triangles[t + k]);
      normals[n] += x;
      normals[n + 1] += y;
      normals[n + 2] += z;
    }
  }
  if (!groups) return;
  for (let v = 0; v < groups.length; ++v) {
    if (groups[v] === v) continue;
    normals.copyWithin(3 * v, 3 * groups[v], 3 * groups[v] + 3);
  }
}

// The edges of triangles as pairs of vertices, each once.
export function edgesOf(triangles, numVertices) {
  const keys = new Float64Array(triangles.length);
  for (let t = 0; t < triangles.length; t += 3) {
    for (let k = 0; k < 3; ++k) {
      const a = triangles[t + k], b = triangles[t + (k + 1) % 3];
      keys[t + k] = Math.min(a, b) * numVertices + Math.max(a, b);
    }
  }
  keys.sort();
  const ends = [];
  for (let k = 0; k < keys.length; ++k) {
    if (k > 0 && keys[k] === keys[k - 1]) continue;
    ends.push(Math.floor(keys[k] / numVertices), keys[k] % numVertices);
  }
  return Uint32Array.from(ends);
}

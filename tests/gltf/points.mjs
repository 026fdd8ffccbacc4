// SPDX-License-Identifier: BSD-3-Clause
// Vertices of .obj and .mesh files, as arrays of three numbers.
import { readFileSync } from 'node:fs';

const wordsOf = (line) => line.trim().split(/\s+/);

function pointsOfObj(text) {
  const lines = text.split('\n').filter((line) => line.startsWith('v '));
  return lines.map((line) => wordsOf(line).slice(1, 4).map(Number));
}

function pointsOfMesh(text) {
  const lines = text.split('\n');
  const first = lines.indexOf('Vertices') + 2;
  return lines.slice(first, first + Number(lines[first - 1])).map((line) => wordsOf(line).slice(0, 3).map(Number));
}

export function readPoints(path) {
  const text = readFileSync(path, 'utf8');
  const points = path.endsWith('.mesh') ? pointsOfMesh(text) : pointsOfObj(text);
  if (points.length === 0) throw new Error(`${path}: no vertices`);
  return points.map(([x, y, z = 0]) => [x, y, z]);
}

// The diagonal of the bounding box.
export function sizeOf(points) {
  const extent = [0, 1, 2].map((axis) => {
    const values = points.map((point) => point[axis]);
    return values.reduce((a, b) => Math.max(a, b)) - values.reduce((a, b) => Math.min(a, b));
  });
  return Math.hypot(...extent);
}

export function distance(a, b) {
  return Math.hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

export function between(a, b) {
  return a.map((point, v) => point.map((x, axis) => (x + b[v][axis]) / 2));
}

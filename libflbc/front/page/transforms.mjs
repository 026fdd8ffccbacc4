// SPDX-License-Identifier: BSD-3-Clause
// Where control points go when they are moved, turned or scaled together.
import { add, centroid, cross, dot, pointAt, setPoint, subtract, times } from "./vectors.mjs";

export const kAxes = { x: [1, 0, 0], y: [0, 1, 0], z: [0, 0, 1] };

// Along which points extend most and least, by Jacobi rotations. Each of the axes has the name of the one
// of the model that is nearest.
export function principalAxes(points, indices) {
  const center = centroid(points, indices), arms = indices.map((i) => subtract(pointAt(points, i), center));
  const sum = (a, b) => arms.reduce((total, arm) => total + dot(arm, a) * dot(arm, b), 0);
  const axes = Object.values(kAxes);
  for (let k = 0; k < 15; ++k) {
    const i = k % 3, j = (k + 1) % 3, [a, b] = [axes[i], axes[j]];
    const angle = Math.atan(2 * sum(a, b) / (sum(a, a) - sum(b, b))) / 2 || 0;
    axes[i] = add(times(Math.cos(angle), a), times(Math.sin(angle), b));
    axes[j] = subtract(times(Math.cos(angle), b), times(Math.sin(angle), a));
  }
  const [x, y, z] = axes;
  return { x, y, z };
}

// Every control point takes its share of a step; without soft selection the share is 1.
const kFully = () => 1;

// Sets the points of `result` that are listed to where `move` takes those of `start`.
function transform(start, indices, move, result, shareOf) {
  for (const i of indices) setPoint(result, i, move(pointAt(start, i), shareOf(i)));
}

export function translate(start, indices, step, result, shareOf = kFully) {
  transform(start, indices, (place, share) => add(place, times(share, step)), result, shareOf);
}

// By an angle in radians round an axis of length 1 through the center.
export function rotate(start, indices, center, axis, angle, result, shareOf = kFully) {
  transform(start, indices, (place, share) => {
    const cosine = Math.cos(share * angle), sine = Math.sin(share * angle);
    const arm = subtract(place, center);
    const along = times((1 - cosine) * dot(axis, arm), axis);
    const turned = add(times(cosine, arm), times(sine, cross(axis, arm)));
    return add(center, add(turned, along));
  }, result, shareOf);
}

// From the center; along one axis only if there is one.
export function scale(start, indices, center, factor, axis, result, shareOf = kFully) {
  transform(start, indices, (place, share) => {
    const arm = subtract(place, center);
    const growth = share * (factor - 1);
    return add(place, axis ? times(growth * dot(axis, arm), axis) : times(growth, arm));
  }, result, shareOf);
}

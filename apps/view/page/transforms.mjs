// SPDX-License-Identifier: BSD-3-Clause
// Where control points go when they are moved, turned or scaled together.
import { add, cross, dot, pointAt, setPoint, subtract, times } from "./vectors.mjs";

export const kAxes = { x: [1, 0, 0], y: [0, 1, 0], z: [0, 0, 1] };

// Sets the points of `result` that are listed to where `move` takes those of `start`.
function transform(start, indices, move, result) {
  for (const i of indices) setPoint(result, i, move(pointAt(start, i)));
}

export function translate(start, indices, step, result) {
  transform(start, indices, (place) => add(place, step), result);
}

// By an angle in radians round an axis of length 1 through the center.
export function rotate(start, indices, center, axis, angle, result) {
  const cosine = Math.cos(angle), sine = Math.sin(angle);
  transform(start, indices, (place) => {
    const arm = subtract(place, center);
    const along = times((1 - cosine) * dot(axis, arm), axis);
    const turned = add(times(cosine, arm), times(sine, cross(axis, arm)));
    return add(center, add(turned, along));
  }, result);
}

// From the center; along one axis only if there is one.
export function scale(start, indices, center, factor, axis, result) {
  transform(start, indices, (place) => {
    const arm = subtract(place, center);
    const grown = axis ? times((factor - 1) * dot(axis, arm), axis) : times(factor - 1, arm);
    return add(place, grown);
  }, result);
}

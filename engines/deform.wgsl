// SPDX-License-Identifier: BSD-3-Clause
// WebGPU: moves a vertex with its cage. The position is the weighted sum of up to 8 control points.
// docs/how-to/engines.md has the attributes.
@group(0) @binding(0) var<storage, read> cage : array<vec4f>;  // x, y, z, unused
@group(0) @binding(1) var<uniform> toClip : mat4x4f;

struct Influences {
  @location(0) firstPoints : vec4u,  // uint16x4: the control points of the largest weights
  @location(1) otherPoints : vec4u,
  @location(2) firstWeights : vec4f,
  @location(3) otherWeights : vec4f,
}

struct Moved {
  @builtin(position) clip : vec4f,
  @location(0) place : vec3f,
}

fn weighted(points : vec4u, weights : vec4f) -> vec3f {
  return (weights.x * cage[points.x] + weights.y * cage[points.y] +
          weights.z * cage[points.z] + weights.w * cage[points.w]).xyz;
}

fn moved(vertex : Influences) -> vec3f {
  return weighted(vertex.firstPoints, vertex.firstWeights) + weighted(vertex.otherPoints, vertex.otherWeights);
}

@vertex
fn main(vertex : Influences) -> Moved {
  let place = moved(vertex);
  return Moved(toClip * vec4f(place, 1.0), place);
}

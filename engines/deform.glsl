#version 300 es
// SPDX-License-Identifier: BSD-3-Clause
// WebGL 2 and OpenGL ES 3: moves a vertex with its cage. The position is the weighted sum of up to
// 8 control points. docs/how-to/engines.md has the attributes.
precision highp float;
uniform sampler2D cage;  // RGB32F, 1024 texels wide: texel i is control point i
uniform mat4 toClip;
layout(location = 0) in uvec4 firstPoints;   // uint16: the control points of the largest weights
layout(location = 1) in uvec4 otherPoints;
layout(location = 2) in vec4 firstWeights;
layout(location = 3) in vec4 otherWeights;
out vec3 place;

vec3 controlPoint(uint i) { return texelFetch(cage, ivec2(i & 1023u, i >> 10), 0).xyz; }

vec3 weighted(uvec4 points, vec4 weights) {
  return weights.x * controlPoint(points.x) + weights.y * controlPoint(points.y) +
         weights.z * controlPoint(points.z) + weights.w * controlPoint(points.w);
}

void main() {
  place = weighted(firstPoints, firstWeights) + weighted(otherPoints, otherWeights);
  gl_Position = toClip * vec4(place, 1.0);
}

// SPDX-License-Identifier: BSD-3-Clause
// The programs of the graphics card.
// Moves vertices as engines/deform.glsl does: the cage is the texture `cage`.
export const kWeightedSum = `
vec3 controlPoint(uint i) { return texelFetch(cage, ivec2(i & 1023u, i >> 10), 0).xyz; }

vec3 weighted(uvec4 points, vec4 weights) {
  return weights.x * controlPoint(points.x) + weights.y * controlPoint(points.y) +
         weights.z * controlPoint(points.z) + weights.w * controlPoint(points.w);
}
`;

// With ON_CARD, `place` is at rest, and the cage has the displacements of the control points.
const kPlace = `
    layout(location = 0) in vec3 place;
    #ifdef ON_CARD
    uniform highp sampler2D cage;
    layout(location = 5) in uvec4 firstPoints;
    layout(location = 6) in uvec4 otherPoints;
    layout(location = 7) in vec4 firstWeights;
    layout(location = 8) in vec4 otherWeights;
    ${kWeightedSum}
    vec3 moved() {
      return place + weighted(firstPoints, firstWeights) + weighted(otherPoints, otherWeights);
    }
    #else
    vec3 moved() { return place; }
    #endif`;

// The shader for models that move on the card.
export function onCard(shader) {
  const define = (text) => text.replace("300 es", "300 es\n    #define ON_CARD");
  return { vertex: define(shader.vertex), fragment: define(shader.fragment) };
}

export const kSurfaceShader = {
  vertex: `#version 300 es
    uniform mat4 toClip;
    uniform mat3 toView;
    ${kPlace}
    layout(location = 1) in vec3 normal;
    layout(location = 2) in float value;
    layout(location = 3) in vec2 textureCoordinate;
    layout(location = 4) in vec3 vertexColor;
    out vec3 viewNormal;
    out float shownValue;
    out vec2 texturePlace;
    out vec3 ownColor;
    void main() {
      vec3 now = moved();
      gl_Position = toClip * vec4(now, 1.0);
      gl_PointSize = 3.0;
    #ifdef ON_CARD
      viewNormal = toView * now;  // the place; the fragment shader takes the normal from it
    #else
      viewNormal = toView * normal;
    #endif
      shownValue = value;
      texturePlace = textureCoordinate;
      ownColor = vertexColor;
    }`,
  // 0: a color; 1: a value; 2: a color and a picture.
  fragment: `#version 300 es
    precision highp float;
    uniform int coloring;
    uniform bool isLit;
    uniform bool hasIsolines;
    uniform vec4 tint;
    uniform float cutoff;
    uniform bool blends;
    uniform sampler2D palette;
    uniform sampler2D picture;
    in vec3 viewNormal;
    in float shownValue;
    in vec2 texturePlace;
    in vec3 ownColor;
    out vec4 color;
    void main() {
      vec4 base = tint * vec4(ownColor, 1.0);
      if (coloring == 1) {
        float value = clamp(shownValue, 0.0, 1.0);
        base = texture(palette, vec2((value * 255.0 + 0.5) / 256.0, 0.5));
        if (hasIsolines && value > 0.05) {
          float steps = 10.0 * shownValue;
          float distance = abs(fract(steps - 0.5) - 0.5) / max(fwidth(steps), 1e-6);
          base.rgb *= mix(0.6, 1.0, smoothstep(0.4, 1.2, distance));
        }
      } else if (coloring == 2) {
        base *= texture(picture, texturePlace);
      }
      if (base.a < cutoff) discard;
      if (isLit) {
    #ifdef ON_CARD
        vec3 across = cross(dFdx(viewNormal), dFdy(viewNormal));
    #else
        vec3 across = viewNormal;
    #endif
        float size = length(across);
        vec3 normal = size > 0.0 ? across / size : vec3(0.0, 0.0, 1.0);
        if (normal.z < 0.0) normal = -normal;
        float light = 0.30 + 0.50 * max(0.0, dot(normal, normalize(vec3(-0.35, 0.55, 0.75))))
                    + 0.26 * normal.z;
        base.rgb *= min(light, 1.06);
      }
      color = vec4(base.rgb, blends ? base.a : 1.0);
    }`,
};

// Edges of the model's triangles, one pixel wide.
export const kEdgeShader = {
  vertex: `#version 300 es
    uniform mat4 toClip;
    ${kPlace}
    void main() { gl_Position = toClip * vec4(moved(), 1.0); }`,
  fragment: `#version 300 es
    precision highp float;
    uniform vec4 ink;
    out vec4 color;
    void main() { color = ink; }`,
};

// Edges of the cage as strips of some pixels' width.
export const kWireShader = {
  vertex: `#version 300 es
    uniform mat4 toClip;
    uniform vec2 halfViewport;
    uniform float halfWidth;
    layout(location = 0) in vec3 first;
    layout(location = 1) in vec3 second;
    out float across;
    void main() {
      vec4 a = toClip * vec4(first, 1.0);
      vec4 b = toClip * vec4(second, 1.0);
      vec2 direction = (b.xy / b.w - a.xy / a.w) * halfViewport;
      float size = max(length(direction), 1e-6);
      vec2 side = vec2(-direction.y, direction.x) / size;
      bool isSecond = gl_VertexID > 1;
      across = gl_VertexID % 2 == 0 ? -1.0 : 1.0;
      vec4 end = isSecond ? b : a;
      vec2 step = (across * side + (isSecond ? 0.5 : -0.5) * direction / size) * (halfWidth + 0.5);
      gl_Position = end + vec4(step / halfViewport * end.w, 0.0, 0.0);
    }`,
  fragment: `#version 300 es
    precision highp float;
    uniform vec4 ink;
    uniform float halfWidth;
    in float across;
    out vec4 color;
    void main() {
      float inside = (1.0 - abs(across)) * (halfWidth + 0.5);
      color = vec4(ink.rgb, ink.a * clamp(inside, 0.0, 1.0));
    }`,
};

// Control points as discs with a rim. Those at the back are smaller and pale, unless the pointer is near.
export const kDotShader = {
  vertex: `#version 300 es
    uniform mat4 toClip;
    uniform float size;
    uniform vec3 pointer;  // in clip coordinates, and the aspect ratio
    uniform vec2 depth;    // as w has it: of the center of the model, and half of its extent
    layout(location = 0) in vec3 place;
    layout(location = 1) in float state;  // share of a step, 1: selected; 2 more: under the pointer; 4: a handle
    out float isSelected;
    out float isHandle;
    out float pixels;
    out float presence;
    void main() {
      gl_Position = toClip * vec4(place, 1.0);
      isSelected = mod(state, 2.0);
      float isNear = step(1.5, mod(state, 4.0));
      isHandle = step(3.5, state);
      vec2 away = (gl_Position.xy / gl_Position.w - pointer.xy) * vec2(pointer.z, 1.0);
      float closeness = 1.0 - smoothstep(0.0, 0.3, length(away));
      float isAway = depth.y > 0.0 ? smoothstep(-0.3, 0.6, (gl_Position.w - depth.x) / depth.y) : 0.0;
      presence = 1.0 - 0.75 * isAway * (1.0 - max(isSelected, max(isNear, closeness)));
      pixels = size * (0.5 + 0.5 * presence + 0.25 * isSelected + 0.35 * isNear + 0.6 * closeness) * (1.0 - 0.2 * isHandle);
      gl_PointSize = pixels;
    }`,
  fragment: `#version 300 es
    precision highp float;
    uniform vec4 ink;
    uniform vec4 highlight;
    uniform vec3 rim;
    in float isSelected;
    in float isHandle;
    in float pixels;
    in float presence;
    out vec4 color;
    void main() {
      float fromCenter = length(gl_PointCoord - 0.5) * pixels;
      float radius = 0.5 * pixels - 0.75;
      vec4 inner = mix(ink, highlight, isSelected);
      float isInner = clamp(radius - 1.2 - fromCenter + 0.5, 0.0, 1.0)
        * (1.0 - isHandle * clamp(0.6 * radius - fromCenter + 0.5, 0.0, 1.0));
      float coverage = clamp(radius - fromCenter + 0.5, 0.0, 1.0);
      color = vec4(mix(rim, inner.rgb, isInner), inner.a * coverage * presence);
    }`,
};

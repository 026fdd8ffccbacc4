// SPDX-License-Identifier: BSD-3-Clause
// The plain data that all drawing code shares.
#pragma once

#include <array>

#include "flbc/types.h"

namespace flbc::draw {

//! A color in sRGB, each component in [0, 1].
struct Color {
  float r = 0;
  float g = 0;
  float b = 0;
};

//! The color a fraction t in [0, 1] of the way from `a` to `b`.
constexpr Color mix(Color a, Color b, float t) {
  return {a.r + t * (b.r - a.r), a.g + t * (b.g - a.g), a.b + t * (b.b - a.b)};
}

constexpr Color kWhite{1, 1, 1};
constexpr Color kInk{0.13F, 0.15F, 0.19F};
constexpr Color kClay{0.84F, 0.76F, 0.68F};  // of models without values
constexpr Color kHighlight{0.90F, 0.07F, 0.10F};
constexpr Color kHiddenHighlight = mix(kHighlight, kWhite, 0.6F);

struct Segment {
  Vector<2> a;
  Vector<2> b;
};

//! The corners of a triangle, in either orientation.
using Corners = std::array<Vector<2>, 3>;

struct Box {
  Vector<2> low;
  Vector<2> high;

  Vector<2> size() const { return high - low; }
  Vector<2> center() const { return (low + high) / 2; }
};

}  // namespace flbc::draw

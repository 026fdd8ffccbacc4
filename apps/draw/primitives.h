// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! The plain data that all drawing code shares.
#pragma once

#include <array>
#include <vector>

#include "flbc/types.h"

namespace flbc::draw {

//! A colour in sRGB, each component in [0, 1].
struct Color {
  float r = 0;
  float g = 0;
  float b = 0;
};

//! The colour a fraction t in [0, 1] of the way from `a` to `b`.
inline Color mix(Color a, Color b, float t) {
  return {a.r + t * (b.r - a.r), a.g + t * (b.g - a.g), a.b + t * (b.b - a.b)};
}

//! A finished picture, rows from top to bottom.
struct Image {
  int width = 0;                //!< pixels
  int height = 0;               //!< pixels
  std::vector<Color> pixels{};  //!< width * height

  Color at(int x, int y) const { return pixels[static_cast<std::size_t>(y) * width + x]; }
};

//! A piece of a straight line.
struct Segment {
  Vector<2> a;
  Vector<2> b;
};

//! The corners of a triangle, in either orientation.
using Corners = std::array<Vector<2>, 3>;

//! An axis-aligned rectangle.
struct Box {
  Vector<2> low;
  Vector<2> high;

  Vector<2> size() const { return high - low; }
  Vector<2> center() const { return (low + high) / 2; }
};

}  // namespace flbc::draw

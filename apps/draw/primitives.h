// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! The plain data that all drawing code shares.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <variant>
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

//! A piece of a straight line.
struct Segment {
  Vector<2> a;
  Vector<2> b;
};

//! Filled areas as a raster, transparent elsewhere. All positions are in pixels of the picture.
struct FilledLayer {
  Vector<2> corner{0, 0};                //!< top left
  double pixel_size = 1;                 //!< of this raster
  int width = 0;                         //!< pixels of this raster
  int height = 0;                        //!< pixels of this raster
  std::vector<std::uint8_t> channels{};  //!< red, green, blue, alpha (not multiplied), row by row
};

//! Lines with round ends, no darker where they meet or cross.
struct LineLayer {
  std::vector<Segment> segments{};
  double width = 1;  //!< in pixels
  Color color{};
  float opacity = 1;
};

//! A filled disc.
struct DiscLayer {
  Vector<2> center{0, 0};
  double radius = 1;
  Color color{};
};

//! A line of text.
struct TextLayer {
  Vector<2> position{0, 0};  //!< left end of the baseline
  std::string text{};
  double height = 1;  //!< of a digit
  Color color{};
};

using Layer = std::variant<FilledLayer, LineLayer, DiscLayer, TextLayer>;

//! A finished picture: pixels, rows from top to bottom, or layers, from the lowest to the topmost.
struct Image {
  int width = 0;                //!< pixels
  int height = 0;               //!< pixels
  std::vector<Color> pixels{};  //!< width * height; empty for one of layers
  std::vector<Layer> layers{};  //!< on white; empty for one of pixels

  Color at(int x, int y) const { return pixels[static_cast<std::size_t>(y) * width + x]; }
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

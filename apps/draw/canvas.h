// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! The raster image that pictures are painted on.
#pragma once

#include <cstdint>
#include <string_view>
#include <utility>
#include <vector>

#include "draw/primitives.h"
#include "draw/triangle_raster.h"

namespace flbc::draw {

//! An anti-aliased picture in the making. Coordinates are pixels from the top left corner, y
//! downwards, so that the centre of pixel (i, j) is (i + 0.5, j + 0.5). What lies outside is cut
//! off. Every pixel is a square of samples that are averaged at the end: areas that abut leave no
//! seam, and thin lines stay smooth, since they blend with the samples by exact distance.
//!
//! A canvas of layers paints filled areas only; lines, discs and text are kept as such.
class Canvas {
 public:
  enum class Kind { kPixels, kLayers };

  //! \param supersampling  samples per pixel in each direction, >= 1
  //! \throws OptionError if a size is below 1 or the picture would need more than 3 GB
  Canvas(int width, int height, Color background, int supersampling = 3,
         Kind kind = Kind::kPixels);

  int width() const { return width_ / supersampling_; }
  int height() const { return height_ / supersampling_; }
  int supersampling() const { return supersampling_; }

  //! Paints a triangle with color(value), the value being interpolated linearly from the corners.
  template <class Colors>
  void fill_triangle(const Corners& corners, const Vector<3>& values, Colors&& color,
                     float opacity = 1) {
    touch(corners);
    const double step1 = values[1] - values[0];
    const double step2 = values[2] - values[0];
    for_each_sample(to_samples(corners), width_, height_, [&](int x, int y, double b1, double b2) {
      blend(x, y, color(values[0] + b1 * step1 + b2 * step2), opacity);
    });
  }

  //! Calls paint(x, y, b1, b2, sample) for each sample in a triangle, b1 and b2 being its
  //! barycentric coordinates for corners 1 and 2; x and y count samples.
  template <class Paint>
  void paint_samples(const Corners& corners, Paint&& paint) {
    touch(corners);
    for_each_sample(to_samples(corners), width_, height_, [&](int x, int y, double b1, double b2) {
      paint(x, y, b1, b2, samples_[static_cast<std::size_t>(y) * width_ + x]);
    });
  }

  //! Paints a triangle in one colour.
  void fill_triangle(const Corners& corners, Color color, float opacity = 1);

  //! Paints the union of line segments with round ends, so that segments that meet or cross are no
  //! darker there.
  //! \param width  in pixels, > 0
  void draw_segments(const std::vector<Segment>& segments, double width, Color color,
                     float opacity = 1);

  //! Paints a disc; `radius` is in pixels.
  void fill_disc(const Vector<2>& center, double radius, Color color);

  //! Keeps a line of text. \return false for a canvas of pixels, on which it has to be drawn
  bool keep_text(const Vector<2>& position, std::string_view text, double height, Color color);

  //! The picture so far.
  Image resolve() const;

 private:
  Corners to_samples(const Corners& corners) const;
  void blend(int x, int y, Color color, float opacity) {
    Color& sample = samples_[static_cast<std::size_t>(y) * width_ + x];
    sample = mix(sample, color, opacity);
  }
  void touch(const Corners& corners);
  bool keep(Layer layer);
  FilledLayer filled_areas() const;
  void cover(const Segment& segment, double radius);
  void paint_covered(Color color, float opacity);

  // The part of the mask that is in use.
  struct Dirty {
    int left, right, top, bottom;
  };

  int supersampling_;
  int width_;   // in samples
  int height_;  // in samples
  std::vector<Color> samples_;
  std::vector<std::uint8_t> mask_;  // coverage by the segments being drawn, all 0 between calls
  Dirty dirty_;                     // in a canvas of layers: what has been filled since the last
  Kind kind_;
  std::vector<Layer> layers_;
};

}  // namespace flbc::draw

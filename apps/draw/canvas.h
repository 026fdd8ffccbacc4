// SPDX-License-Identifier: BSD-3-Clause
// A picture drawn by Cairo, in any format. Builds without Cairo refuse to make one.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "draw/picture_options.h"
#include "draw/raster.h"

struct _cairo;
struct _cairo_surface;

namespace flbc::draw {

//! Whether this program was built with Cairo.
bool can_draw();

//! Coordinates are pixels from the top left corner with y downwards, so that the center of pixel
//! (i, j) is (i + 0.5, j + 0.5).
class Canvas {
 public:
  //! A white picture. \throws OptionError if it has no pixels or too many, or unless can_draw()
  Canvas(int width, int height, PictureFormat format);
  Canvas(const Canvas&) = delete;
  Canvas& operator=(const Canvas&) = delete;

  Raster raster_for(const PointList<2>& points) const { return {points, width_, height_}; }
  void draw_raster(Raster& raster);

  //! Draws the union of line segments with round ends, no darker where they meet or cross.
  //! \param width  in pixels
  void draw_segments(const std::vector<Segment>& segments, double width, Color color,
                     float opacity = 1);
  //! Draws discs, which are shortest in files as points of a wide line.
  void fill_discs(const std::vector<Vector<2>>& centers, double radius, Color color);

  //! \param position  left end of the baseline, \param height  of a digit in pixels
  void draw_text(const Vector<2>& position, const std::string& text, double height, Color color);

  //! The bytes of the file, after which nothing can be drawn. The same picture gives the same
  //! bytes.
  //! \throws IoError if Cairo could not draw or encode it
  std::string encode();

 private:
  std::string encode_png() const;

  int width_;
  int height_;
  PictureFormat format_;
  std::string bytes_;
  std::unique_ptr<_cairo_surface, void (*)(_cairo_surface*)> surface_;
  std::unique_ptr<_cairo, void (*)(_cairo*)> cairo_;
};

double text_width(const std::string& text, double height);

}  // namespace flbc::draw

// SPDX-License-Identifier: BSD-3-Clause
// Where things stand in a picture.
#pragma once

#include <vector>

#include "draw/picture_options.h"
#include "front/primitives.h"

namespace flbc::draw {

//! From a plane with y upwards to pixels with y downwards, by one scale for both directions.
class PixelMap {
 public:
  //! Maps `content` as large as possible into the middle of `frame`.
  PixelMap(const Box& content, const Box& frame);

  Vector<2> operator()(const Vector<2>& p) const {
    return {offset_.x() + scale_ * p.x(), offset_.y() - scale_ * p.y()};
  }
  PointList<2> operator()(const PointList<2>& points) const;

  //! Pixels per unit of length.
  double scale() const { return scale_; }

 private:
  double scale_;
  Vector<2> offset_;
};

//! The smallest box with all points. \throws InputError if it has no extent or is not finite
Box bounding_box(const PointList<2>& points);

//! A picture of panels in rows, with a label above each and, if wanted, a color bar at the right.
struct SheetLayout {
  int width;                  //!< of the sheet in pixels
  int height;                 //!< of the sheet in pixels
  double unit;                //!< size of what is 1 pixel wide in a picture of the usual width
  std::vector<Box> frames{};  //!< of the panels
  Box color_bar{};            //!< for the colored part of the bar
};

//! Panels are as high as the content demands. One or two of them are at most 1.3 times as high as
//! wide; the number of others per row makes the sheet about 4:3, with few gaps in the last row.
//! \param count  of panels, >= 1 \param has_bar  whether to leave room for the color bar
SheetLayout plan_sheet(const Box& content, int count, const WeightPictureOptions& options,
                       bool has_bar = false);

}  // namespace flbc::draw

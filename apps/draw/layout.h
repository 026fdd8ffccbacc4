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

struct PoseLayout {
  bool in_a_row;  //!< from left to right, else from top to bottom
  double gap;     //!< between two poses
};

//! \param size  of a box that any of the poses fits in
inline PoseLayout arrange_poses(const Vector<2>& size) {
  return {size.x() < 1.6 * size.y(), 0.06 * size.maxCoeff()};
}

//! A picture with one drawing and, if wanted, a color bar at the right.
struct PictureLayout {
  int width;      //!< of the picture in pixels
  int height;     //!< of the picture in pixels
  Box frame;      //!< for the drawing
  Box color_bar;  //!< for the colored part of the bar
};

//! The width is as demanded. The height of the drawing follows from the content, but is no less
//! than 0.27 times and no more than 1.3 times the width.
PictureLayout plan_picture(const Box& content, const WeightPictureOptions& options);

//! A sheet of small pictures in rows, with a label above each.
struct SheetLayout {
  int width;                  //!< of the sheet in pixels
  int height;                 //!< of the sheet in pixels
  std::vector<Box> frames{};  //!< of the pictures
  double label_height;        //!< of a digit
  //! Middle of the baseline of a picture's label.
  Vector<2> label(int k) const {
    return {frames[k].center().x(), frames[k].low.y() - label_height};
  }
};

//! Pictures are as wide as the content demands, their number per row makes the sheet about 4:3,
//! with few gaps in the last row.
//! \param count  of pictures, >= 1
SheetLayout plan_sheet(const Box& content, int count, const WeightPictureOptions& options);

}  // namespace flbc::draw

// SPDX-License-Identifier: BSD-3-Clause
// The parts of which the pictures of weights consist, for domains in the plane and models. All
// positions and sizes are in pixels of the canvas.
#pragma once

#include <string>
#include <vector>

#include "draw/canvas.h"
#include "draw/picture_options.h"

namespace flbc::draw {

//! Paints a function: its colors and its isolines.
//! \param points  2 x V, \param values  V
void paint_weight(Canvas& canvas, const PointList<2>& points, const CellList<2>& cells,
                  const Eigen::VectorXd& values, const WeightPictureOptions& options);

//! Paints control points as dots with a white rim.
void paint_dots(Canvas& canvas, const std::vector<Vector<2>>& centers, double radius, Color color);

//! Paints the scale of the colors, upright in the box, with its numbers at the right, "w" with the
//! number of the control point above it, below and above the scale the colors of weights outside
//! [0, 1], if `least` and `greatest` say that there are any, and the line of the support.
void paint_color_bar(Canvas& canvas, const Box& box, Index control_point, double least,
                     double greatest, const WeightPictureOptions& options);

constexpr const char* kRestLabel = "Rest";
constexpr const char* kPoseLabel = "Pose";

//! Writes a label above what it names. \param top  middle of its upper side \param unit  as
//! pixel_unit()
void paint_label(Canvas& canvas, const Vector<2>& top, const std::string& label, double unit);

}  // namespace flbc::draw

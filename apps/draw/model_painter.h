// SPDX-License-Identifier: BSD-3-Clause
// A shaded surface with the wire of its cage, as part of a picture.
#pragma once

#include <array>
#include <vector>

#include "draw/canvas.h"
#include "draw/layout.h"
#include "draw/view.h"

namespace flbc::draw {

//! A model's surface and its cage's edges, wherever their points are.
struct DrawnModel {
  FacetList<3> triangles{};                        //!< 3 x T, of the model's points
  std::vector<std::array<Index, 2>> cage_edges{};  //!< of control points
};

struct ModelPlace {
  PointList<3> control_points;  //!< 3 x n
  PointList<3> points;          //!< 3 x P
};

struct ModelScene {
  const DrawnModel& model;
  const ModelPlace& place;
  const Eigen::VectorXd& values;  //!< P, shown as weights are; empty for a plain model
  Index control_point;            //!< in red; -1 = none
  ObliqueView view;
  PixelMap map;  //!< of the view's plane
  double unit;   //!< size of what is 1 pixel wide in a picture of the usual width
};

//! Paints the surface alone, pale and whatever the values: where a model was before.
void paint_ghost(Canvas& canvas, const ModelScene& scene);

//! Paints the surface with its nearest parts in front, lit from the upper left, and over it the
//! wire, pale where the surface hides it, with
//! the control points that it does not hide.
void paint_model(Canvas& canvas, const ModelScene& scene);

}  // namespace flbc::draw

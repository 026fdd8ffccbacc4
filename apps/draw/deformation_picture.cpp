// SPDX-License-Identifier: BSD-3-Clause
#include "draw/deformation_picture.h"

#include <algorithm>

#include "draw/plane_painter.h"
#include "draw/weight_painter.h"
#include "flbc/errors.h"

namespace flbc::draw {
namespace {

void check_shape(const CellList<2>& triangles, const DrawnShape& shape, const DrawnShape& other) {
  const auto num_points = shape.points.cols();
  if (num_points != other.points.cols() ||
      shape.control_points.cols() != other.control_points.cols()) {
    throw InputError("the shape or its cage has another number of points before than after");
  }
  if (!shape.points.allFinite()) throw InputError("a point of the shape is not finite");
  if (triangles.size() > 0 && (triangles.minCoeff() < 0 || triangles.maxCoeff() >= num_points)) {
    throw InputError("a triangle of the shape refers to a point that does not exist");
  }
}

// All that either shape covers: the cage and what lies outside it.
Box common_box(const DrawnShape& before, const DrawnShape& after) {
  PointList<2> all(2, 2 * (before.points.cols() + before.control_points.cols()));
  all << before.points, before.control_points, after.points, after.control_points;
  return bounding_box(all);
}

}  // namespace

Image draw_deformation(const FacetList<2>& facets, const CellList<2>& triangles,
                       const DrawnShape& before, const DrawnShape& after,
                       const Eigen::VectorXd& values, Index control_point,
                       const WeightPictureOptions& options) {
  validate(options);
  check_shape(triangles, before, after);
  check_shape(triangles, after, before);
  check_weight(values, static_cast<Index>(before.points.cols()), control_point,
               static_cast<Index>(before.control_points.cols()));

  const Box content = common_box(before, after);
  const Vector<2> size = content.size();
  const bool beside = size.x() < 1.6 * size.y();
  const double gap = 0.06 * size.maxCoeff();
  const Vector<2> step = beside ? Vector<2>(size.x() + gap, 0) : Vector<2>(0, size.y() + gap);
  // Both in one plane: the first at the left or above.
  const Vector<2> first = content.low + (beside ? Vector<2>(0, 0) : step);
  const Vector<2> second = content.low + (beside ? step : Vector<2>(0, 0));
  const Box both{content.low, content.high + step};

  const PictureLayout layout = plan_picture(both, options);
  const PixelMap map(both, layout.frame);
  const double unit = std::max(0.6, pixel_unit(options));
  Canvas canvas = new_canvas(layout.width, layout.height, options);
  const auto outline = outline_of(triangles);
  const auto paint = [&](const DrawnShape& shape, const Vector<2>& place) {
    const Vector<2> shift = place - content.low;
    const Cage<2> cage{shape.control_points.colwise() + shift, facets};
    const DomainMesh<2> mesh{shape.points.colwise() + shift, triangles};
    check_edges(cage);
    paint_outline(canvas, map, mesh.points, outline, unit);
    paint_function(canvas, map, cage, mesh, values, control_point, options, unit);
  };
  paint(before, first);
  paint(after, second);
  if (options.color_bar) {
    paint_color_bar(canvas, layout.color_bar, control_point, values.minCoeff(), values.maxCoeff(),
                    options);
  }
  return canvas.resolve();
}

}  // namespace flbc::draw

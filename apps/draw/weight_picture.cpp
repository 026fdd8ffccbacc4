// SPDX-License-Identifier: BSD-3-Clause
#include "draw/weight_picture.h"

#include <algorithm>
#include <cmath>

#include "draw/canvas.h"
#include "draw/layout.h"
#include "draw/weight_painter.h"
#include "flbc/errors.h"

namespace flbc::draw {
namespace {

// Dots shrink where control points are dense, so that the polygon remains visible.
double dot_radius(const Cage<2>& cage, const PixelMap& map, double unit) {
  double length = 0;
  for (const auto& facet : cage.facets.colwise()) {
    length += (cage.points.col(facet[1]) - cage.points.col(facet[0])).norm();
  }
  const double average =
      map.scale() * length / static_cast<double>(std::max<Eigen::Index>(1, cage.facets.cols()));
  return std::clamp(0.2 * average, 1.5 * unit, 6 * unit);
}

void paint_cage(Canvas& canvas, const Cage<2>& cage, const PixelMap& map, Index control_point,
                double unit) {
  std::vector<Segment> edges;
  for (const auto& facet : cage.facets.colwise()) {
    edges.push_back(
        {map(Vector<2>(cage.points.col(facet[0]))), map(Vector<2>(cage.points.col(facet[1])))});
  }
  canvas.draw_segments(edges, 2.6 * unit, kInk);
  const double radius = dot_radius(cage, map, unit);
  for (const auto& point : cage.points.colwise()) {
    paint_dot(canvas, map(Vector<2>(point)), radius, kInk);
  }
  // Last and largest, so that neighbours never hide it.
  paint_dot(canvas, map(Vector<2>(cage.points.col(control_point))),
            std::max(1.5 * radius, 6 * unit), kHighlight);
}

void paint_function(Canvas& canvas, const Box& content, const Box& frame, const Cage<2>& cage,
                    const DomainMesh<2>& mesh, const Eigen::VectorXd& values, Index control_point,
                    const WeightPictureOptions& options, double unit) {
  const PixelMap map(content, frame);
  paint_weight(canvas, map(mesh.points), mesh.cells, values, options);
  paint_cage(canvas, cage, map, control_point, unit);
}

void check_cage(const Cage<2>& cage) {
  if (cage.facets.size() > 0 &&
      (cage.facets.minCoeff() < 0 || cage.facets.maxCoeff() >= cage.size())) {
    throw InputError("an edge of the cage refers to a control point that does not exist");
  }
}

}  // namespace

Image draw_weights(const Cage<2>& cage, const DomainMesh<2>& mesh, const Eigen::VectorXd& values,
                   Index control_point, const WeightPictureOptions& options) {
  validate(options);
  check_cage(cage);
  check_weight(values, mesh.num_vertices(), control_point, cage.size());
  const Box content = bounding_box(cage.points);
  const PictureLayout layout = plan_picture(content, options);
  Canvas canvas(layout.width, layout.height, kWhite);
  paint_function(canvas, content, layout.frame, cage, mesh, values, control_point, options,
                 std::max(0.6, pixel_unit(options)));
  if (options.color_bar) {
    paint_color_bar(canvas, layout.color_bar, control_point, values.minCoeff(), values.maxCoeff(),
                    options);
  }
  return canvas.resolve();
}

Image draw_all(const Cage<2>& cage, const DomainMesh<2>& mesh, const WeightMatrix& weights,
               const std::vector<Index>& control_points, const WeightPictureOptions& options) {
  validate(options);
  check_cage(cage);
  if (control_points.empty()) throw OptionError("there is no control point to draw");
  const Box content = bounding_box(cage.points);
  const int count = static_cast<int>(control_points.size());

  // Tiles are as wide as the content demands, their number per row makes the sheet about 4:3.
  const double aspect = std::clamp(content.size().y() / content.size().x(), 0.2, 5.0);
  const int columns =
      std::clamp(static_cast<int>(std::lround(std::sqrt(4.0 / 3 * aspect * count))), 1, count);
  const int rows = (count + columns - 1) / columns;
  const double unit = pixel_unit(options);
  const double margin = 26 * unit;
  const double label = 44 * unit;
  const double tile_width = (options.width - margin) / columns - margin;
  const double tile_height = aspect * tile_width;
  const double row_height = label + tile_height + margin;

  Canvas canvas(options.width, static_cast<int>(std::lround(rows * row_height + margin / 2)),
                kWhite);
  for (int k = 0; k < count; ++k) {
    const Index control_point = control_points[k];
    check_weight(control_point >= 0 && control_point < weights.rows()
                     ? Eigen::VectorXd(weights.row(control_point))
                     : Eigen::VectorXd(),
                 mesh.num_vertices(), control_point, cage.size());
    const Vector<2> corner(margin + (k % columns) * (tile_width + margin),
                           label + (k / columns) * row_height);
    const Box frame{corner, corner + Vector<2>(tile_width, tile_height)};
    paint_function(canvas, content, frame, cage, mesh, weights.row(control_point), control_point,
                   options, std::max(0.6, 0.7 * unit));
    paint_symbol(canvas, {frame.center().x(), corner.y() - 18 * unit}, control_point, 18 * unit);
  }
  return canvas.resolve();
}

}  // namespace flbc::draw

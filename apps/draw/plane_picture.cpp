// SPDX-License-Identifier: BSD-3-Clause
#include "draw/plane_picture.h"

#include <algorithm>
#include <map>
#include <string>
#include <utility>

#include "draw/layout.h"
#include "draw/weight_painter.h"

namespace flbc::draw {
namespace {

constexpr Color kDarkClay{0.70F, 0.60F, 0.51F};

// Dots shrink where control points are dense, so that the polygon remains visible.
double dot_radius(const Cage<2>& cage, const PixelMap& map, double unit) {
  double length = 0;
  for (const auto& facet : cage.facets.colwise()) {
    length += (cage.points.col(facet[1]) - cage.points.col(facet[0])).norm();
  }
  const double average =
      map.scale() * length / static_cast<double>(std::max<Eigen::Index>(1, cage.facets.cols()));
  return std::clamp(0.12 * average, 1.5 * unit, 6 * unit);
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
  std::vector<Vector<2>> dots;
  for (const auto& point : cage.points.colwise()) dots.push_back(map(Vector<2>(point)));
  paint_dots(canvas, dots, radius, kInk);
  if (control_point < 0) return;
  // Last and largest, so that neighbors never hide it.
  paint_dots(canvas, {dots[control_point]}, std::max(1.5 * radius, 5 * unit), kHighlight);
}

// Edges of one triangle only: they show the shape where the function is 0.
std::vector<Segment> outline_of(const PointList<2>& points, const CellList<2>& triangles) {
  std::map<std::pair<Index, Index>, int> counts;
  for (const auto& corners : triangles.colwise()) {
    for (int k = 0; k < 3; ++k) ++counts[std::minmax({corners[k], corners[(k + 1) % 3]})];
  }
  std::vector<Segment> outline;
  for (const auto& [ends, count] : counts) {
    if (count == 1) outline.push_back({points.col(ends.first), points.col(ends.second)});
  }
  return outline;
}

void paint_function(Canvas& canvas, const PixelMap& map, const Cage<2>& cage,
                    const DomainMesh<2>& mesh, const Eigen::VectorXd& values, Index control_point,
                    const WeightPictureOptions& options, double unit) {
  const PointList<2> points = map(mesh.points);
  canvas.draw_segments(outline_of(points, mesh.cells), 2.4 * unit, kInk, 0.8F);
  paint_weight(canvas, points, mesh.cells, values, options);
  paint_cage(canvas, cage, map, control_point, unit);
}

// Squares of the shape at rest, which show how it is deformed.
void paint_checker(Canvas& canvas, const PointList<2>& pixels, const CellList<2>& triangles,
                   const PointList<2>& rest) {
  constexpr double kSquares = 40;  // along the larger side
  const Vector<2> low = rest.rowwise().minCoeff();
  const double square = (rest.rowwise().maxCoeff() - low).maxCoeff() / kSquares;
  Raster raster = canvas.raster_for(pixels);
  for (const auto& t : triangles.colwise()) {
    raster.fill({pixels.col(t[0]), pixels.col(t[1]), pixels.col(t[2])}, Vector<3>::Zero(),
                [&](double b0, double b1, double b2) {
                  const Vector<2> at =
                      (b0 * rest.col(t[0]) + b1 * rest.col(t[1]) + b2 * rest.col(t[2]) - low) /
                      square;
                  const auto sum = static_cast<int>(at.x()) + static_cast<int>(at.y());
                  return sum % 2 == 0 ? kClay : kDarkClay;
                });
  }
  canvas.draw_raster(raster);
}

// A shape in its cage, colored by values or, without any, in squares.
void paint_shape(Canvas& canvas, const PixelMap& map, const Cage<2>& cage,
                 const DomainMesh<2>& mesh, const PointList<2>& rest, const Eigen::VectorXd& values,
                 Index control_point, const WeightPictureOptions& options, double unit) {
  if (values.size() > 0) {
    return paint_function(canvas, map, cage, mesh, values, control_point, options, unit);
  }
  const PointList<2> pixels = map(mesh.points);
  canvas.draw_segments(outline_of(pixels, mesh.cells), 2.4 * unit, kInk, 0.8F);
  paint_checker(canvas, pixels, mesh.cells, rest);
  paint_cage(canvas, cage, map, -1, unit);
}

}  // namespace

std::string draw_weights(const Cage<2>& cage, const DomainMesh<2>& mesh,
                         const Eigen::VectorXd& values, Index control_point,
                         const WeightPictureOptions& options) {
  const auto shape = std::make_shared<const DrawnShape>(DrawnShape{cage.points, mesh.points});
  return draw_panels(cage.facets, mesh.cells, {{"", shape, values, control_point}}, mesh.points,
                     options);
}

std::string draw_panels(const FacetList<2>& facets, const CellList<2>& triangles,
                        const std::vector<PlanePanel>& panels, const PointList<2>& rest,
                        const WeightPictureOptions& options) {
  validate(options);
  PointList<2> corners(2, 0);
  for (const auto& panel : panels) {
    for (const auto* points : {&panel.shape->points, &panel.shape->control_points}) {
      corners.conservativeResize(2, corners.cols() + 2);
      corners.rightCols(2) << points->rowwise().minCoeff(), points->rowwise().maxCoeff();
    }
  }
  const Box content = bounding_box(corners);
  const auto& first = panels.front();
  const bool has_bar = options.color_bar && panels.size() == 1 && first.control_point >= 0;
  const auto sheet = plan_sheet(content, static_cast<int>(panels.size()), options, has_bar);
  Canvas canvas(sheet.width, sheet.height, options.format);
  for (std::size_t k = 0; k < panels.size(); ++k) {
    const auto& [label, shape, values, control_point] = panels[k];
    const auto& frame = sheet.frames[k];
    paint_shape(canvas, PixelMap(content, frame), {shape->control_points, facets},
                {shape->points, triangles}, rest, values, control_point, options, sheet.unit);
    paint_label(canvas, {frame.center().x(), frame.low.y()}, label, sheet.unit);
  }
  if (has_bar) {
    paint_color_bar(canvas, sheet.color_bar, first.control_point, first.values.minCoeff(),
                    first.values.maxCoeff(), options);
  }
  return canvas.encode();
}

std::string draw_poses(const FacetList<2>& facets, const CellList<2>& triangles,
                       const DrawnShape& rest, const DrawnShape& pose,
                       const WeightPictureOptions& options) {
  const std::vector<PlanePanel> panels{{kRestLabel, std::make_shared<const DrawnShape>(rest)},
                                       {kPoseLabel, std::make_shared<const DrawnShape>(pose)}};
  return draw_panels(facets, triangles, panels, rest.points, options);
}

}  // namespace flbc::draw

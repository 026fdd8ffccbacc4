// SPDX-License-Identifier: BSD-3-Clause
#include "draw/plane_picture.h"

#include <algorithm>
#include <map>
#include <sstream>
#include <string>
#include <utility>

#include "draw/layout.h"
#include "draw/weight_painter.h"
#include "flbc/errors.h"

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

void check_edges(const Cage<2>& cage) {
  if (cage.facets.size() > 0 &&
      (cage.facets.minCoeff() < 0 || cage.facets.maxCoeff() >= cage.size())) {
    throw InputError("an edge of the cage refers to a control point that does not exist");
  }
}

void check_shape(const CellList<2>& triangles, const DrawnShape& shape, const DrawnShape& other) {
  const auto num_points = shape.points.cols();
  if (num_points != other.points.cols() ||
      shape.control_points.cols() != other.control_points.cols()) {
    throw InputError(
        "the model or its cage has another number of vertices at rest than in the pose");
  }
  if (!shape.points.allFinite()) throw InputError("a vertex of the model is not finite");
  if (triangles.size() > 0 && (triangles.minCoeff() < 0 || triangles.maxCoeff() >= num_points)) {
    throw InputError("a triangle of the model refers to a vertex that does not exist");
  }
}

// All that either shape covers: the cage and what lies outside it.
Box common_box(const DrawnShape& before, const DrawnShape& after) {
  PointList<2> all(2, 2 * (before.points.cols() + before.control_points.cols()));
  all << before.points, before.control_points, after.points, after.control_points;
  return bounding_box(all);
}

}  // namespace

std::string draw_weights(const Cage<2>& cage, const DomainMesh<2>& mesh,
                         const Eigen::VectorXd& values, Index control_point,
                         const WeightPictureOptions& options) {
  validate(options);
  check_edges(cage);
  check_weight(values, mesh.num_vertices(), control_point, cage.size());
  const Box content = bounding_box(cage.points);
  const PictureLayout layout = plan_picture(content, options);
  Canvas canvas(layout.width, layout.height, options.format);
  const PixelMap map(content, layout.frame);
  const double unit = std::max(0.6, pixel_unit(options));
  paint_function(canvas, map, cage, mesh, values, control_point, options, unit);
  if (options.color_bar) {
    paint_color_bar(canvas, layout.color_bar, control_point, values.minCoeff(), values.maxCoeff(),
                    options);
  }
  return canvas.encode();
}

std::string draw_all(const Cage<2>& cage, const DomainMesh<2>& mesh, const WeightMatrix& weights,
                     const std::vector<Index>& control_points,
                     const WeightPictureOptions& options) {
  validate(options);
  check_edges(cage);
  if (control_points.empty()) throw OptionError("there is no control point to draw");
  const Box content = bounding_box(cage.points);
  const int count = static_cast<int>(control_points.size());
  const auto sheet = plan_sheet(content, count, options);
  Canvas canvas(sheet.width, sheet.height, options.format);
  const double unit = std::max(0.6, 0.7 * pixel_unit(options));
  for (int k = 0; k < count; ++k) {
    const Index control_point = control_points[k];
    check_weight(control_point >= 0 && control_point < weights.rows()
                     ? Eigen::VectorXd(weights.row(control_point))
                     : Eigen::VectorXd(),
                 mesh.num_vertices(), control_point, cage.size());
    const PixelMap map(content, sheet.frames[k]);
    paint_function(canvas, map, cage, mesh, weights.row(control_point), control_point, options,
                   unit);
    paint_symbol(canvas, sheet.label(k), control_point, sheet.label_height);
  }
  return canvas.encode();
}

std::string draw_deformation(const FacetList<2>& facets, const CellList<2>& triangles,
                             const DrawnShape& before, const DrawnShape& after,
                             const Eigen::VectorXd& values, Index control_point,
                             const WeightPictureOptions& options) {
  validate(options);
  check_shape(triangles, before, after);
  check_shape(triangles, after, before);
  const bool checkered = values.size() == 0;
  if (!checkered) {
    check_weight(values, static_cast<Index>(before.points.cols()), control_point,
                 static_cast<Index>(before.control_points.cols()));
  }

  const Box content = common_box(before, after);
  const Vector<2> size = content.size();
  const auto [in_a_row, gap] = arrange_poses(size);
  const Vector<2> step = in_a_row ? Vector<2>(size.x() + gap, 0) : Vector<2>(0, size.y() + gap);
  // Both in one plane: the first at the left or above.
  const Vector<2> first = content.low + (in_a_row ? Vector<2>(0, 0) : step);
  const Vector<2> second = content.low + (in_a_row ? step : Vector<2>(0, 0));
  const Box both{content.low, content.high + step};

  auto shown = options;
  shown.color_bar = options.color_bar && !checkered;
  const PictureLayout layout = plan_picture(both, shown);
  const PixelMap map(both, layout.frame);
  const double unit = std::max(0.6, pixel_unit(options));
  Canvas canvas(layout.width, layout.height, options.format);
  const auto paint = [&](const DrawnShape& shape, const Vector<2>& place, const char* label) {
    const Vector<2> shift = place - content.low;
    const Cage<2> cage{shape.control_points.colwise() + shift, facets};
    const DomainMesh<2> mesh{shape.points.colwise() + shift, triangles};
    check_edges(cage);
    paint_shape(canvas, map, cage, mesh, before.points, values, control_point, options, unit);
    paint_label(canvas, map(Vector<2>(place.x() + size.x() / 2, place.y() + size.y())), label,
                pixel_unit(options));
  };
  paint(before, first, kRestLabel);
  paint(after, second, kPoseLabel);
  if (shown.color_bar) {
    paint_color_bar(canvas, layout.color_bar, control_point, values.minCoeff(), values.maxCoeff(),
                    options);
  }
  return canvas.encode();
}

std::string draw_panels(const FacetList<2>& facets, const CellList<2>& triangles,
                        const std::vector<PlanePanel>& panels, const PointList<2>& rest,
                        Index control_point, const WeightPictureOptions& options) {
  validate(options);
  if (panels.empty()) throw InputError("there is nothing to draw");
  PointList<2> all(2, 0);
  for (const auto& [label, shape, values] : panels) {
    check_shape(triangles, shape, panels.front().shape);
    check_edges({shape.control_points, facets});
    const auto before = all.cols();
    all.conservativeResize(2, before + shape.points.cols() + shape.control_points.cols());
    all.rightCols(all.cols() - before) << shape.points, shape.control_points;
  }
  const Box content = bounding_box(all);
  const auto sheet = plan_sheet(content, static_cast<int>(panels.size()), options);
  Canvas canvas(sheet.width, sheet.height, options.format);
  const double unit = std::max(0.6, 0.7 * pixel_unit(options));
  for (std::size_t k = 0; k < panels.size(); ++k) {
    const auto& [label, shape, values] = panels[k];
    const auto& frame = sheet.frames[k];
    const PixelMap map(content, frame);
    const Cage<2> cage{shape.control_points, facets};
    if (values.size() > 0) {
      check_weight(values, static_cast<Index>(shape.points.cols()), control_point, cage.size());
    }
    paint_shape(canvas, map, cage, {shape.points, triangles}, rest, values, control_point, options,
                unit);
    paint_label(canvas, {frame.center().x(), frame.low.y()}, label, unit);
  }
  return canvas.encode();
}

}  // namespace flbc::draw

// SPDX-License-Identifier: BSD-3-Clause
#include "draw/plane_painter.h"

#include <algorithm>
#include <map>

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
  for (const auto& point : cage.points.colwise()) {
    paint_dot(canvas, map(Vector<2>(point)), radius, kInk);
  }
  // Last and largest, so that neighbours never hide it.
  paint_dot(canvas, map(Vector<2>(cage.points.col(control_point))),
            std::max(1.5 * radius, 5 * unit), kHighlight);
}

}  // namespace

void paint_function(Canvas& canvas, const PixelMap& map, const Cage<2>& cage,
                    const DomainMesh<2>& mesh, const Eigen::VectorXd& values, Index control_point,
                    const WeightPictureOptions& options, double unit) {
  paint_weight(canvas, map(mesh.points), mesh.cells, values, options);
  paint_cage(canvas, cage, map, control_point, unit);
}

std::vector<std::pair<Index, Index>> outline_of(const CellList<2>& triangles) {
  std::map<std::pair<Index, Index>, int> counts;
  for (const auto& corners : triangles.colwise()) {
    for (int k = 0; k < 3; ++k) ++counts[std::minmax({corners[k], corners[(k + 1) % 3]})];
  }
  std::vector<std::pair<Index, Index>> outline;
  for (const auto& [ends, count] : counts) {
    if (count == 1) outline.push_back(ends);
  }
  return outline;
}

void paint_outline(Canvas& canvas, const PixelMap& map, const PointList<2>& points,
                   const std::vector<std::pair<Index, Index>>& outline, double unit) {
  std::vector<Segment> segments;
  segments.reserve(outline.size());
  for (const auto& [a, b] : outline) {
    segments.push_back({map(Vector<2>(points.col(a))), map(Vector<2>(points.col(b)))});
  }
  canvas.draw_segments(segments, 2.4 * unit, kInk, 0.8F);
}

void check_edges(const Cage<2>& cage) {
  if (cage.facets.size() > 0 &&
      (cage.facets.minCoeff() < 0 || cage.facets.maxCoeff() >= cage.size())) {
    throw InputError("an edge of the cage refers to a control point that does not exist");
  }
}

}  // namespace flbc::draw

// SPDX-License-Identifier: BSD-3-Clause
#include "draw/model_painter.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <Eigen/Geometry>

#include "draw/weight_painter.h"
#include "front/colormap.h"

namespace flbc::draw {
namespace {

constexpr Color kGhost{0.93F, 0.94F, 0.95F};
constexpr float kHiddenOpacity = 0.22F;

Vector<2> pixel_of(const ModelScene& scene, const Vector<3>& place) {
  return scene.map(scene.view.project(place));
}

// A normal for each corner of each triangle, in the coordinates of the view: of the triangles at
// the vertex without those beyond a sharp edge.
PointList<3> corner_normals(const ModelScene& scene) {
  constexpr double kSmooth = 0.6;  // cosine between triangles that look curved
  const auto& points = scene.place.points;
  const auto& triangles = scene.model.triangles;
  Eigen::Matrix3d to_view;
  to_view << scene.view.right.transpose(), scene.view.up.transpose(), scene.view.toward.transpose();
  PointList<3> areas(3, triangles.cols());  // normals as long as the areas
  std::vector<std::vector<Index>> around(points.cols());
  for (Index f = 0; f < triangles.cols(); ++f) {
    const auto t = triangles.col(f);
    const Vector<3> a = points.col(t[0]), u = points.col(t[1]) - a, v = points.col(t[2]) - a;
    areas.col(f) = to_view * u.cross(v);
    for (const Index p : t) around[p].push_back(f);
  }
  PointList<3> normals = PointList<3>::Zero(3, 3 * triangles.cols());
  for (Index k = 0; k < normals.cols(); ++k) {
    const Vector<3> own = areas.col(k / 3);
    for (const Index f : around[triangles(k % 3, k / 3)]) {
      const Vector<3> other = areas.col(f);
      if (own.dot(other) >= kSmooth * own.norm() * other.norm()) normals.col(k) += other;
    }
    normals.col(k).stableNormalize();
  }
  return normals;
}

// Brightness of a surface seen from its front or its back.
double light_on(const Vector<3>& normal) {
  static const Vector<3> lamp = Vector<3>(-0.35, 0.55, 0.75).normalized();
  const double size = normal.norm();
  if (size == 0) return 1;
  const double sign = normal.z() < 0 ? -1 : 1;
  const Vector<3> front = sign / size * normal;
  return std::min(1.0, 0.34 + 0.46 * std::max(0.0, front.dot(lamp)) + 0.26 * front.z());
}

// Whether the surface covers a place that is not on it.
bool is_hidden(const Raster& surface, const ModelScene& scene, const Vector<3>& place) {
  const double tolerance = 4 * scene.unit / scene.map.scale();
  return surface.hides(pixel_of(scene, place), scene.view.toward.dot(place) + tolerance);
}

// Samples that are hidden in the end need no color then.
std::vector<Index> nearest_first(const FacetList<3>& triangles, const Eigen::VectorXd& nearness) {
  std::vector<Index> order(triangles.cols());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](Index f, Index g) {
    return nearness[triangles(0, f)] > nearness[triangles(0, g)];
  });
  return order;
}

Raster painted_surface(const Canvas& canvas, const ModelScene& scene, Color plain) {
  const auto& points = scene.place.points;
  const PointList<3> normals = corner_normals(scene);
  const Eigen::VectorXd nearness = points.transpose() * scene.view.toward;
  PointList<2> pixels(2, points.cols());
  for (Eigen::Index p = 0; p < points.cols(); ++p) pixels.col(p) = pixel_of(scene, points.col(p));
  Raster raster = canvas.raster_for(pixels);
  for (const Index f : nearest_first(scene.model.triangles, nearness)) {
    const auto t = scene.model.triangles.col(f);
    const Index a = t[0], b = t[1], c = t[2];
    raster.fill({pixels.col(a), pixels.col(b), pixels.col(c)},
                {nearness[a], nearness[b], nearness[c]}, [&](double b0, double b1, double b2) {
                  const Color color = scene.values.size() == 0 ? plain
                                                               : weight_color(b0 * scene.values[a] +
                                                                              b1 * scene.values[b] +
                                                                              b2 * scene.values[c]);
                  const Vector<3> normal = normals.middleCols<3>(3 * f) * Vector<3>(b0, b1, b2);
                  return mix({0, 0, 0}, color, static_cast<float>(light_on(normal)));
                });
  }
  return raster;
}

// The wire, pale where the surface hides it.
void paint_wire(Canvas& canvas, const Raster& surface, const ModelScene& scene) {
  constexpr double kPiece = 2;  // pixels
  std::vector<Segment> visible, hidden;
  for (const auto& [i, j] : scene.model.cage_edges) {
    const Vector<3> from = scene.place.control_points.col(i);
    const Vector<3> to = scene.place.control_points.col(j);
    const Vector<2> begin = pixel_of(scene, from), end = pixel_of(scene, to);
    const int pieces = std::clamp(static_cast<int>((end - begin).norm() / kPiece), 1, 10000);
    std::vector<Segment>* last = nullptr;  // where the piece before is
    for (int k = 0; k < pieces; ++k) {
      const double t0 = static_cast<double>(k) / pieces, t1 = static_cast<double>(k + 1) / pieces;
      const Vector<3> middle = from + (t0 + t1) / 2 * (to - from);
      auto& pieces_of = is_hidden(surface, scene, middle) ? hidden : visible;
      if (&pieces_of != last) pieces_of.push_back({begin + t0 * (end - begin), begin});
      pieces_of.back().b = begin + t1 * (end - begin);
      last = &pieces_of;
    }
  }
  canvas.draw_segments(hidden, 1.5 * scene.unit, kInk, kHiddenOpacity);
  canvas.draw_segments(visible, 1.7 * scene.unit, kInk, 0.85F);
}

double dot_radius(const ModelScene& scene) {
  double length = 0;
  for (const auto& [i, j] : scene.model.cage_edges) {
    length += (pixel_of(scene, scene.place.control_points.col(i)) -
               pixel_of(scene, scene.place.control_points.col(j)))
                  .norm();
  }
  const auto count = static_cast<double>(std::max<std::size_t>(1, scene.model.cage_edges.size()));
  return std::clamp(0.06 * length / count, 1.2 * scene.unit, 5 * scene.unit);
}

void paint_control_points(Canvas& canvas, const Raster& surface, const ModelScene& scene) {
  const auto& places = scene.place.control_points;
  std::vector<Vector<2>> visible;
  for (Eigen::Index i = 0; i < places.cols(); ++i) {
    const Vector<3> place = places.col(i);
    if (!is_hidden(surface, scene, place)) visible.push_back(pixel_of(scene, place));
  }
  const double radius = dot_radius(scene);
  paint_dots(canvas, visible, radius, kInk);
  if (scene.control_point < 0) return;
  // Last and largest, so that neighbors never hide it; pale behind the model.
  const Vector<3> place = places.col(scene.control_point);
  paint_dots(canvas, {pixel_of(scene, place)}, std::max(1.6 * radius, 5 * scene.unit),
             is_hidden(surface, scene, place) ? kHiddenHighlight : kHighlight);
}

}  // namespace

void paint_ghost(Canvas& canvas, const ModelScene& scene) {
  Raster surface = painted_surface(canvas, scene, kGhost);
  canvas.draw_raster(surface);
}

void paint_model(Canvas& canvas, const ModelScene& scene) {
  Raster surface = painted_surface(canvas, scene, kClay);
  canvas.draw_raster(surface);
  paint_wire(canvas, surface, scene);
  paint_control_points(canvas, surface, scene);
}

}  // namespace flbc::draw

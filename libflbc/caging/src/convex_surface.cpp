// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include "caging/cage_steps.h"
#include "caging/mirror_plane.h"
#include "caging/surface_tools.h"

namespace flbc {

namespace {

// Turned so that points extend least along x, and most along z.
struct Frame {
  Eigen::Matrix3d axes;  // columns
  Vector<3> low, extent;

  explicit Frame(const PointList<3>& points) {
    const PointList<3> centered = points.colwise() - points.rowwise().mean();
    axes = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(centered * centered.transpose())
               .eigenvectors();
    const PointList<3> turned = axes.transpose() * points;
    low = turned.rowwise().minCoeff();
    extent = turned.rowwise().maxCoeff() - low;
  }
};

Vector<3> centroid(const Cage<3>& surface) {
  const Vector<3> origin = surface.points.rowwise().mean();
  Vector<3> sum = Vector<3>::Zero();
  double volume = 0;
  for (const auto& facet : surface.facets.colwise()) {
    const Eigen::Matrix3d corners = surface.points(Eigen::all, facet).eval().colwise() - origin;
    volume += corners.determinant();
    sum += corners.determinant() * corners.rowwise().sum() / 4;
  }
  return origin + sum / volume;
}

// The hull without points that only rounding, as in files of single precision, has made corners.
// They are in a face, on an edge, or at another point. \param size  of the points
Cage<3> hull_of_corners(const PointList<3>& points, double size) {
  const double tolerance = 1.618e-6 * size;  // round places are at no border of cells
  auto hull = convex_hull(simplified<3>(points, {}, tolerance).points);
  for (;;) {
    PointList<3> normals = PointList<3>::Zero(3, hull.size());
    for (const auto& facet : hull.facets.colwise()) {
      const Eigen::Matrix3d corners = hull.points(Eigen::all, facet);
      const Vector<3> normal = facet_normal<3>(corners);
      const double length = (corners.colwise() - corners.col(0)).colwise().norm().maxCoeff();
      if (!(normal.norm() > tolerance * length)) continue;
      for (const Index v : facet) normals.col(v) += normal.normalized();
    }
    std::vector<bool> is_flat(hull.size(), false);
    for (const auto& facet : hull.facets.colwise()) {
      for (int k = 0; k < 3; ++k) {
        // By convexity, all neighbors of a corner are below it.
        const Index v = facet(k), next = facet((k + 1) % 3);
        const Vector<3> edge = hull.points.col(v) - hull.points.col(next);
        is_flat[v] = is_flat[v] || (!is_flat[next] && normals.col(v).dot(edge) < tolerance);
      }
    }
    std::vector<Index> corners;
    for (Index v = 0; v < hull.size(); ++v) {
      if (!is_flat[v]) corners.push_back(v);
    }
    if (static_cast<Index>(corners.size()) == hull.size()) return hull;
    hull = convex_hull(hull.points(Eigen::all, corners));
  }
}

// A hull of fewer points, enlarged to enclose the hull; round models have thousands. \param center
// inside of it
Cage<3> coarser(const Cage<3>& hull, const Vector<3>& center) {
  constexpr Index kMany = 1500;
  if (hull.size() <= kMany) return hull;
  auto coarse = convex_hull(
      simplified<3>(hull.points, hull.facets, std::sqrt(area_of(hull.points, hull.facets) / kMany))
          .points);
  const PointList<3> centered = coarse.points.colwise() - center;
  Eigen::Matrix<double, Eigen::Dynamic, 3> planes(coarse.facets.cols(), 3);  // x is 1 on a facet
  for (Index f = 0; f < coarse.facets.cols(); ++f) {
    const Eigen::Matrix3d corners = centered(Eigen::all, coarse.facets.col(f));
    const Vector<3> normal = facet_normal<3>(corners);
    planes.row(f) = normal.transpose() / normal.dot(corners.col(0));
  }
  double scale = 1;
  for (const auto& point : hull.points.colwise()) {
    scale = std::max(scale, (planes * (point - center)).maxCoeff());
  }
  coarse.points = (scale * centered).colwise() + center;
  return coarse;
}

}  // namespace

ConvexSurface convex_surface(const PointList<3>& points, double thickness) {
  constexpr double kEnlarged = 1.01;
  constexpr double kRod = 2.5;                       // relation of extents
  constexpr double kSpacing = 1.4, kMostRings = 40;  // spacing relative to the width
  constexpr double kNoLimit = std::numeric_limits<double>::infinity();
  const Frame frame(points);
  const Vector<3>& extent = frame.extent;
  if (!(extent.y() > kFlat * extent.z())) return {{}, 0, kNoLimit, 0};
  PointList<3> solid = points;
  if (!(extent.x() > kFlat * extent.z())) {
    solid.resize(3, 2 * points.cols());
    solid << points.colwise() + thickness / 2 * frame.axes.col(0),
        points.colwise() - thickness / 2 * frame.axes.col(0);
  }
  ConvexSurface result{hull_of_corners(solid, extent.z()), 0, kNoLimit, 0};
  auto& surface = result.surface;
  const Vector<3> center = centroid(surface);
  result.hull_volume = signed_measure<3>(surface, center);
  surface = coarser(surface, center);
  result.offset = (kEnlarged - 1) * result.hull_volume / area_of(surface.points, surface.facets);
  surface.points = (kEnlarged * (surface.points.colwise() - center)).colwise() + center;
  if (!(extent.z() > kRod * extent.y())) return result;
  const double rings = std::min(std::floor(extent.z() / (kSpacing * extent.y())), kMostRings);
  const double spacing = extent.z() / (rings + 1);
  surface.points = frame.axes.transpose() * surface.points;
  for (double ring = 1; ring <= rings; ++ring) {
    surface = cut_along<3>(surface, {2, frame.low.z() + ring * spacing});
  }
  surface.points = frame.axes * surface.points;
  result.edge_length = kSpacing * spacing;
  return result;
}

}  // namespace flbc

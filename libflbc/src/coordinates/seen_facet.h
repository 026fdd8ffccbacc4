// SPDX-License-Identifier: BSD-3-Clause
// A cage facet as seen from a point: its contributions to mean value weights. The weight of c_i,
// before division by their sum, is the integral of phi_i(p) / |p - x| over all directions from x,
// where p is the point of the cage in that direction, and phi_i the barycentric coordinate of p in
// its facet.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <Eigen/Geometry>

#include "base/shape_checks.h"
#include "flbc/cage.h"

namespace flbc {

constexpr double kInPlane = 1e-18;  // fraction of cage size within which a point is in the facet
                                    // plane

template <int Dim>
struct SeenFacet;

template <>
struct SeenFacet<2> {
  Eigen::Matrix2d corners;

  SeenFacet(const Eigen::Matrix2d& facet_corners, double) : corners(facet_corners) {}

  // tan(alpha / 2) / r at both ends, where alpha is the angle subtended by the edge. Of two
  // expressions for the tangent, the one without cancellation is used.
  Vector<2> share(const Vector<2>& x) const {
    const Vector<2> to_a = corners.col(0) - x;
    const Vector<2> to_b = corners.col(1) - x;
    const double a = to_a.norm();
    const double b = to_b.norm();
    const double cross = to_a.x() * to_b.y() - to_a.y() * to_b.x();
    const double dot = to_a.dot(to_b);
    const double tangent = dot > 0 ? cross / (a * b + dot) : (a * b - dot) / cross;
    return {tangent / a, tangent / b};
  }
};

// In 3D, the integral over directions equals h times the integral of phi_i / r^4 over the triangle,
// where h is the distance of its plane from x. The integral of 1 / r^4 is `density`. The slope of
// phi_i contributes edge terms by the divergence theorem. Unlike the formula with spherical angles,
// this one stays accurate for points near the plane of the triangle.
template <>
struct SeenFacet<3> {
  Eigen::Matrix3d corners;
  Eigen::Matrix3d along;    // unit vectors; edge k is opposite to corner k
  Eigen::Matrix3d inwards;  // unit normals of the edges, in the plane, toward corner k
  Vector<3> lengths;        // of the edges
  Vector<3> heights;        // of the corners over the edges
  Vector<3> normal;         // unit, outward
  double in_plane;

  SeenFacet(const Eigen::Matrix3d& facet_corners, double size)
      : corners(facet_corners), in_plane(kInPlane * size) {
    for (int k = 0; k < 3; ++k) along.col(k) = corners.col((k + 2) % 3) - corners.col((k + 1) % 3);
    normal = along.col(0).cross(along.col(1));
    lengths = along.colwise().norm();
    heights = normal.norm() * lengths.cwiseInverse();
    normal.normalize();
    along.colwise().normalize();
    for (int k = 0; k < 3; ++k) inwards.col(k) = normal.cross(along.col(k));
  }

  // Geometry of an edge relative to x and its foot point in the plane of the triangle.
  struct Edge {
    double angle;     // subtended angle
    double inverse;   // integral of 1 / r^2 along it
    double inside;    // distance of the foot point from the edge line, positive inward
    double distance;  // of x from the edge line
    double from, to;  // edge ends on its line, measured from the point nearest to x
  };

  Edge see_edge(int k, const Eigen::Matrix3d& to, double height) const {
    const Vector<3> a = to.col((k + 1) % 3);
    const Vector<3> b = to.col((k + 2) % 3);
    const double cross = lengths[k] * a.cross(along.col(k)).norm();
    const double dot = a.dot(b);
    Edge edge;
    edge.angle = std::atan2(cross, dot);
    edge.inverse = lengths[k] * (cross > 1e-8 * dot ? edge.angle / cross : 1 / dot);
    edge.inside = -inwards.col(k).dot(a);
    edge.distance = std::sqrt(edge.inside * edge.inside + height * height);
    edge.from = a.dot(along.col(k));
    edge.to = b.dot(along.col(k));
    return edge;
  }

  // Integral of 1 / r^4 over the triangle.
  static double density(const std::array<Edge, 3>& edges, double height) {
    const double square = height * height;
    if (!is_seen_from_side(edges, height)) {
      double sum = 0;
      for (const Edge& e : edges) sum += e.inside / e.distance * e.angle;
      return sum / (2 * square);
    }
    // The same with each angle reduced by the angle at the foot point of x. Those angles sum to
    // zero, and every small term has the factor height^2, which cancels.
    double sum = 0;
    for (const Edge& e : edges) {
      const double off = std::abs(e.inside);
      const auto difference = [&](double end) {
        const double ratio = end / ((e.distance + off) * (off * e.distance + end * end));
        const double tangent = square * ratio;
        return std::abs(tangent) < 1e-8 ? ratio : std::atan(tangent) / square;
      };
      sum += std::copysign(
          difference(e.to) - difference(e.from) + e.angle / (e.distance * (e.distance + off)),
          e.inside);
    }
    return -sum / 2;
  }

  // Whether terms cancel, because x is near the plane and its foot point is far outside the
  // triangle.
  static bool is_seen_from_side(const std::array<Edge, 3>& edges, double height) {
    if (edges[0].inside >= 0 && edges[1].inside >= 0 && edges[2].inside >= 0) return false;
    for (const Edge& e : edges) {
      const double beyond = std::max({0.0, e.from, -e.to});
      if (height * height >= 0.01 * (e.inside * e.inside + beyond * beyond)) return false;
    }
    return true;
  }

  Vector<3> share(const Vector<3>& x) const {
    const Eigen::Matrix3d to = corners.colwise() - x;
    const double height = normal.dot(to.col(0));
    if (std::abs(height) <= in_plane) return Vector<3>::Zero();
    const std::array<Edge, 3> edges{see_edge(0, to, height), see_edge(1, to, height),
                                    see_edge(2, to, height)};
    const Vector<3> inside(edges[0].inside, edges[1].inside, edges[2].inside);
    const Vector<3> flow =
        inwards * Vector<3>(edges[0].inverse, edges[1].inverse, edges[2].inverse) / 2;
    return height *
           (density(edges, height) * inside + inwards.transpose() * flow).cwiseQuotient(heights);
  }
};

template <int Dim>
std::vector<SeenFacet<Dim>> see_facets(const Cage<Dim>& cage, double size) {
  check_elements(cage.points, cage.facets, kCageNames);
  std::vector<SeenFacet<Dim>> facets;
  facets.reserve(cage.facets.cols());
  for (Index f = 0; f < cage.facets.cols(); ++f) {
    facets.emplace_back(cage.points(Eigen::all, cage.facets.col(f)), size);
  }
  return facets;
}

}  // namespace flbc

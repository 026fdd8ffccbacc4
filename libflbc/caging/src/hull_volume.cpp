// SPDX-License-Identifier: BSD-3-Clause
#include "caging/hull_volume.h"

#include <array>
#include <set>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

namespace flbc {
namespace {

// Grows a hull point by point. Each point adds the tetrahedra between it and the facets that see
// it, and the facets between it and the horizon.
class GrowingHull {
 public:
  explicit GrowingHull(const PointList<3>& points) : points_(points) {}

  // A triangle with two sides, a hull without volume.
  void start(const std::array<Index, 3>& corners) {
    add_facet(corners[0], corners[1], corners[2]);
    add_facet(corners[0], corners[2], corners[1]);
  }

  void add(Index point) {
    std::set<std::pair<Index, Index>> edges;
    std::size_t kept = 0;
    for (const auto& facet : facets_) {
      const double height = facet.normal.dot(points_.col(point)) - facet.offset;
      if (height > 0) {
        volume_ += height / 6;
        for (int k = 0; k < 3; ++k) edges.emplace(facet.corners[k], facet.corners[(k + 1) % 3]);
      } else {
        facets_[kept++] = facet;
      }
    }
    facets_.resize(kept);
    for (const auto& [a, b] : edges) {
      if (edges.count({b, a}) == 0) add_facet(a, b, point);
    }
  }

  double volume() const { return volume_; }

 private:
  struct Facet {
    std::array<Index, 3> corners;
    Vector<3> normal;  // twice as long as the area
    double offset;
  };

  void add_facet(Index a, Index b, Index c) {
    const Vector<3> origin = points_.col(a);
    const Vector<3> normal =
        Vector<3>(points_.col(b) - origin).cross(Vector<3>(points_.col(c) - origin));
    facets_.push_back({{a, b, c}, normal, normal.dot(origin)});
  }

  const PointList<3>& points_;
  std::vector<Facet> facets_;
  double volume_ = 0;
};

// The point farthest from the flat through others. \param distances  squared
Index farthest(const Eigen::RowVectorXd& distances) {
  Eigen::Index point;
  distances.maxCoeff(&point);
  return static_cast<Index>(point);
}

}  // namespace

double hull_volume(const PointList<3>& points) {
  const PointList<3> offsets = points.colwise() - points.col(0);
  const Index a = farthest(offsets.colwise().squaredNorm());
  const PointList<3> from_a = points.colwise() - points.col(a);
  const Index b = farthest(from_a.colwise().squaredNorm());
  const Vector<3> along = from_a.col(b).normalized();
  const PointList<3> beside = from_a - along * (along.transpose() * from_a);
  const Index c = farthest(beside.colwise().squaredNorm());
  const Vector<3> normal = along.cross(Vector<3>(beside.col(c))).normalized();
  const Index d = farthest((normal.transpose() * from_a).cwiseAbs2());
  GrowingHull hull(points);
  hull.start({a, b, c});
  hull.add(d);
  for (Index point = 0; point < static_cast<Index>(points.cols()); ++point) hull.add(point);
  return hull.volume();
}

}  // namespace flbc

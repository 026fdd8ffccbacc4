// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <numeric>
#include <vector>

#include "base/instantiate.h"
#include "base/parallel.h"
#include "flbc/bounding_box.h"
#include "flbc/check.h"
#include "polytope/nearest_point_in_hull.h"

namespace flbc {
namespace {

// The last of the nearest control points whose hull contains a point; -1 if no hull does.
template <int Dim>
Index last_needed(const PointList<Dim>& control_points, const Vector<Dim>& point,
                  double tolerance) {
  PointList<Dim> offsets = control_points.colwise() - point;
  const Eigen::VectorXd distances = offsets.colwise().squaredNorm();
  std::vector<Index> order(control_points.cols());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](Index a, Index b) { return distances[a] < distances[b]; });
  offsets = PointList<Dim>(offsets(Eigen::all, order));
  Eigen::Index count = 1;
  for (;;) {
    const auto nearest = nearest_point_in_hull<Dim>(offsets.leftCols(count), Vector<Dim>::Zero());
    if (nearest.distance <= tolerance) return order[count - 1];
    // A plane separates the point from them. It stays until one on its other side is added.
    do {
      if (count == offsets.cols()) return -1;
    } while (nearest.point.dot(offsets.col(count++)) > 0);
  }
}

}  // namespace

template <int Dim>
LeastReach<Dim> least_reach(const Cage<Dim>& cage, const PointList<Dim>& points) {
  constexpr double kOnHull = 1e-10;  // of the cage size
  const double size = bounding_box_diagonal(cage.points);
  std::vector<Index> needed(points.cols());
  parallel_for(points.cols(), [&](Eigen::Index p) {
    needed[p] = last_needed<Dim>(cage.points, points.col(p), kOnHull * size);
  });
  LeastReach<Dim> reach;
  std::vector<double> all;
  for (Index p = 0; p < points.cols(); ++p) {
    if (needed[p] < 0) continue;
    all.push_back((cage.points.col(needed[p]) - points.col(p)).norm() / size);
    if (all.size() > 1 && all.back() <= reach.maximum.value) continue;
    reach.maximum = {all.back(), p, needed[p], points.col(p)};
  }
  if (all.empty()) return reach;
  const auto middle = all.begin() + all.size() / 2;
  std::nth_element(all.begin(), middle, all.end());
  reach.median = *middle;
  return reach;
}

FLBC_INSTANTIATE_FUNCTION(least_reach)

}  // namespace flbc

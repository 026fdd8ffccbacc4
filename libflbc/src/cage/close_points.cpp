// SPDX-License-Identifier: BSD-3-Clause
#include "cage/close_points.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/instantiate.h"

namespace flbc {

namespace {

// No axis and no common diagonal: points of grids and boxes do not project onto each other, so the
// sweep below does not compare all pairs.
template <int Dim>
Vector<Dim> sweep_direction() {
  Vector<Dim> direction;
  for (int axis = 0; axis < Dim; ++axis) direction(axis) = std::sqrt(2.0 + 3.1 * axis * axis);
  return direction.normalized();
}

}  // namespace

template <int Dim>
std::vector<std::array<Index, 2>> find_close_pairs(const PointList<Dim>& points, double tolerance,
                                                   std::size_t limit) {
  const Eigen::VectorXd height = points.transpose() * sweep_direction<Dim>();
  std::vector<Index> order(static_cast<std::size_t>(points.cols()));
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](Index a, Index b) {
    return height(a) != height(b) ? height(a) < height(b) : a < b;
  });

  // Rounding of the projections must not hide a pair.
  const double reach =
      tolerance + (points.cols() > 0 ? 1e-15 * height.template lpNorm<Eigen::Infinity>() : 0.0);
  std::vector<std::array<Index, 2>> pairs;
  for (std::size_t i = 0; i < order.size(); ++i) {
    for (std::size_t j = i; j-- > 0;) {
      if (height(order[i]) - height(order[j]) > reach) break;
      if ((points.col(order[i]) - points.col(order[j])).norm() > tolerance) continue;
      pairs.push_back({std::min(order[i], order[j]), std::max(order[i], order[j])});
      break;
    }
  }
  std::sort(pairs.begin(), pairs.end(),
            [](const auto& a, const auto& b) { return a[1] != b[1] ? a[1] < b[1] : a[0] < b[0]; });
  if (pairs.size() > limit) pairs.resize(limit);
  return pairs;
}

FLBC_INSTANTIATE_FUNCTION(find_close_pairs)

}  // namespace flbc

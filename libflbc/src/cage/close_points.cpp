// SPDX-License-Identifier: BSD-3-Clause
#include "cage/close_points.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/instantiate.h"

namespace flbc {

template <int Dim>
Eigen::VectorXd sweep_heights(const PointList<Dim>& points) {
  Vector<Dim> direction;
  for (int axis = 0; axis < Dim; ++axis) direction(axis) = std::sqrt(2.0 + 3.1 * axis * axis);
  return points.transpose() * direction.normalized();
}

double sweep_reach(const Eigen::VectorXd& heights, double tolerance) {
  return tolerance + (heights.size() > 0 ? 1e-15 * heights.lpNorm<Eigen::Infinity>() : 0.0);
}

template <int Dim>
std::vector<std::array<Index, 2>> find_close_pairs(const PointList<Dim>& points, double tolerance,
                                                   std::size_t limit) {
  const auto height = sweep_heights<Dim>(points);
  std::vector<Index> order(static_cast<std::size_t>(points.cols()));
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](Index a, Index b) {
    return height(a) != height(b) ? height(a) < height(b) : a < b;
  });

  const double reach = sweep_reach(height, tolerance);
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

FLBC_INSTANTIATE_FUNCTION(sweep_heights)
FLBC_INSTANTIATE_FUNCTION(find_close_pairs)

}  // namespace flbc

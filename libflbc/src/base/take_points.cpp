// SPDX-License-Identifier: BSD-3-Clause
#include "base/take_points.h"

#include <cstdint>
#include <utility>

namespace flbc {

SparseWeights take_points(const SparseWeights& weights, const std::vector<Index>& points) {
  std::vector<std::int64_t> starts{0};
  std::vector<std::uint32_t> control_points;
  std::vector<double> values;
  starts.reserve(points.size() + 1);
  std::int64_t count = 0;
  for (const Index p : points) count += weights.count(p);
  control_points.reserve(static_cast<std::size_t>(count));
  values.reserve(static_cast<std::size_t>(count));
  for (const Index p : points) {
    const auto begin = weights.starts()[p], end = weights.starts()[p + 1];
    const auto* numbers = weights.control_points().data();
    control_points.insert(control_points.end(), numbers + begin, numbers + end);
    values.insert(values.end(), weights.values().data() + begin, weights.values().data() + end);
    starts.push_back(static_cast<std::int64_t>(values.size()));
  }
  return {weights.num_control_points(), std::move(starts), std::move(control_points),
          std::move(values)};
}

}  // namespace flbc

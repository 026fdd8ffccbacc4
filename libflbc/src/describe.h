// SPDX-License-Identifier: BSD-3-Clause
// How control points and element numbers appear in messages to the user.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "flbc/types.h"
#include "format.h"

namespace flbc {

//! "control point 7 at (1, 2)".
template <int Dim>
std::string describe_control_point(const PointList<Dim>& points, Index vertex) {
  return "control point " + std::to_string(vertex) + " at " + format_point(points.col(vertex));
}

//! "3 and 4", "3, 4 and 5"; long lists end in "and N more".
inline std::string describe_list(const std::vector<Index>& numbers) {
  constexpr std::size_t kMostShown = 6;
  const std::size_t shown = std::min(numbers.size(), kMostShown);
  std::string text;
  for (std::size_t i = 0; i < shown; ++i) {
    const bool is_last = i + 1 == numbers.size();
    if (i > 0) text += is_last ? " and " : ", ";
    text += std::to_string(numbers[i]);
  }
  if (shown < numbers.size()) text += " and " + std::to_string(numbers.size() - shown) + " more";
  return text;
}

}  // namespace flbc

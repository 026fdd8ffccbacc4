// SPDX-License-Identifier: BSD-3-Clause
// Equal columns of a matrix.
#pragma once

#include <algorithm>
#include <numeric>
#include <vector>

#include "flbc/types.h"

namespace flbc {

//! For every column, the first equal one.
template <int Rows>
std::vector<Index> first_equals(const PointList<Rows>& columns) {
  const auto is_less = [&](Index a, Index b) {
    return std::lexicographical_compare(columns.col(a).begin(), columns.col(a).end(),
                                        columns.col(b).begin(), columns.col(b).end());
  };
  std::vector<Index> order(static_cast<std::size_t>(columns.cols())), first(order.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), is_less);
  for (std::size_t k = 0; k < order.size(); ++k) {
    const bool is_new = k == 0 || is_less(order[k - 1], order[k]);
    first[order[k]] = is_new ? order[k] : first[order[k - 1]];
  }
  return first;
}

}  // namespace flbc

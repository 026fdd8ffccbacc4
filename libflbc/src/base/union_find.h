// SPDX-License-Identifier: BSD-3-Clause
// Disjoint sets of the integers 0 .. size-1.
#pragma once

#include <numeric>
#include <vector>

#include "flbc/types.h"

namespace flbc {

class UnionFind {
 public:
  explicit UnionFind(Index size) : parent_(static_cast<std::size_t>(size)) {
    std::iota(parent_.begin(), parent_.end(), 0);
  }

  //! The representative of the set of `element`; halves the path.
  Index find(Index element) {
    while (parent_[element] != element) {
      parent_[element] = parent_[parent_[element]];
      element = parent_[element];
    }
    return element;
  }

  //! The smaller representative is kept, so results do not depend on the order of calls.
  void unite(Index a, Index b) {
    const Index root_a = find(a), root_b = find(b);
    if (root_a < root_b) {
      parent_[root_b] = root_a;
    } else {
      parent_[root_a] = root_b;
    }
  }

 private:
  std::vector<Index> parent_;
};

}  // namespace flbc

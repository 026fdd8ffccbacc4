// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! What belongs to each vertex.
#pragma once

#include <numeric>
#include <vector>

#include "flbc/types.h"

namespace flbc {

//! Items that belong to vertices, in one array.
template <class Item>
struct VertexItems {
  std::vector<Index> start;  //!< V + 1
  std::vector<Item> items;

  struct Range {
    const Item* first;
    const Item* last;
    const Item* begin() const { return first; }
    const Item* end() const { return last; }
  };
  Range of(Index vertex) const {
    return {items.data() + start[vertex], items.data() + start[vertex + 1]};
  }
};

//! Sorts items by vertex, otherwise in their order. \param for_each  calls what it is given with
//! every vertex and item; is called twice, to count and to store
template <class Item, class ForEach>
VertexItems<Item> items_by_vertex(Index num_vertices, const ForEach& for_each) {
  VertexItems<Item> sorted{std::vector<Index>(num_vertices + 1, 0), {}};
  auto& start = sorted.start;
  for_each([&](Index vertex, const Item&) { ++start[vertex + 1]; });
  std::partial_sum(start.begin(), start.end(), start.begin());
  sorted.items.resize(start.back());
  std::vector<Index> next(start.begin(), start.end() - 1);
  for_each([&](Index vertex, const Item& item) { sorted.items[next[vertex]++] = item; });
  return sorted;
}

}  // namespace flbc

// SPDX-License-Identifier: BSD-3-Clause
// Items by vertex, and the cells around each vertex.
#pragma once

#include <cstddef>
#include <numeric>
#include <vector>

#include "flbc/domain_mesh.h"

namespace flbc {

//! Items of vertices, in one array. \tparam Offset  counts all items
template <class Item, class Offset = Index>
struct VertexItems {
  std::vector<Offset> start;  //!< V + 1
  std::vector<Item> items;

  struct Range {
    const Item* first;
    const Item* last;
    const Item* begin() const { return first; }
    const Item* end() const { return last; }
  };
  Range of(std::size_t vertex) const {
    return {items.data() + start[vertex], items.data() + start[vertex + 1]};
  }
};

//! Groups items by vertex in a stable order. \param for_each  calls its argument with every vertex
//! and item; called twice, to count and to store
template <class Item, class Offset = Index, class ForEach>
VertexItems<Item, Offset> items_by_vertex(std::size_t num_vertices, const ForEach& for_each) {
  VertexItems<Item, Offset> sorted{std::vector<Offset>(num_vertices + 1, 0), {}};
  auto& start = sorted.start;
  for_each([&](std::size_t vertex, const Item&) { ++start[vertex + 1]; });
  std::partial_sum(start.begin(), start.end(), start.begin());
  sorted.items.resize(start.back());
  std::vector<Offset> next(start.begin(), start.end() - 1);
  for_each([&](std::size_t vertex, const Item& item) { sorted.items[next[vertex]++] = item; });
  return sorted;
}

//! Cells around every vertex, ascending, in one array.
class VertexCells {
 public:
  template <int Dim>
  explicit VertexCells(const DomainMesh<Dim>& mesh)
      : around_(items_by_vertex<Index>(mesh.num_vertices(), [&](const auto& visit) {
          for (Index s = 0; s < mesh.num_cells(); ++s) {
            for (const Index v : mesh.cells.col(s)) visit(v, s);
          }
        })) {}

  VertexItems<Index>::Range cells_of(Index vertex) const { return around_.of(vertex); }

  //! The same as plain arrays: V + 1 offsets, and the cells.
  const Index* starts() const { return around_.start.data(); }
  const Index* cells() const { return around_.items.data(); }

 private:
  VertexItems<Index> around_;
};

}  // namespace flbc

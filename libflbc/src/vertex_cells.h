// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! The cells around each vertex.
#pragma once

#include <vector>

#include "flbc/domain_mesh.h"

namespace flbc {

//! Cells around every vertex, ascending, in one array.
class VertexCells {
 public:
  template <int Dim>
  explicit VertexCells(const DomainMesh<Dim>& mesh)
      : start_(mesh.num_vertices() + 1, 0), cells_(mesh.cells.size()) {
    for (const Index v : mesh.cells.reshaped()) ++start_[v + 1];
    for (Index v = 0; v < mesh.num_vertices(); ++v) start_[v + 1] += start_[v];
    std::vector<Index> next(start_.begin(), start_.end() - 1);
    for (Index s = 0; s < mesh.num_cells(); ++s) {
      for (int k = 0; k <= Dim; ++k) cells_[next[mesh.cells(k, s)]++] = s;
    }
  }

  struct Range {
    const Index* first;
    const Index* last;
    const Index* begin() const { return first; }
    const Index* end() const { return last; }
  };

  Range cells_of(Index vertex) const {
    return {cells_.data() + start_[vertex], cells_.data() + start_[vertex + 1]};
  }

  //! The same as plain arrays: where the cells of each vertex begin, V + 1, and the cells.
  const Index* starts() const { return start_.data(); }
  const Index* cells() const { return cells_.data(); }

 private:
  std::vector<Index> start_;
  std::vector<Index> cells_;
};

}  // namespace flbc

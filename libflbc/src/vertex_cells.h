// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! The cells around each vertex.
#pragma once

#include "flbc/domain_mesh.h"
#include "vertex_items.h"

namespace flbc {

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

  //! The same as plain arrays: where the cells of each vertex begin, V + 1, and the cells.
  const Index* starts() const { return around_.start.data(); }
  const Index* cells() const { return around_.items.data(); }

 private:
  VertexItems<Index> around_;
};

}  // namespace flbc

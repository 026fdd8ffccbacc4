// SPDX-License-Identifier: BSD-3-Clause
// A tetrahedral mesh that can be changed locally.
#pragma once

#include <array>
#include <vector>

#include "flbc/domain_mesh.h"

namespace flbc {

//! Cells and vertices with the cells at each vertex. Numbers of vertices and cells stay valid;
//! removed cells keep theirs.
class CellComplex {
 public:
  using Corners = std::array<Index, 4>;
  using Simplex = std::vector<Index>;  //!< an edge or triangle of the mesh

  explicit CellComplex(const DomainMesh<3>& mesh);

  const Vector<3>& point(Index vertex) const { return points_[vertex]; }
  Index num_vertices() const { return static_cast<Index>(points_.size()); }
  Index num_cells() const { return static_cast<Index>(cells_.size()); }
  bool is_alive(Index cell) const { return is_alive_[cell]; }
  bool is_used(Index vertex) const;

  const Corners& corners(Index cell) const { return cells_[cell]; }
  std::array<Vector<3>, 4> corner_points(Index cell) const;

  Index add_vertex(const Vector<3>& point);
  void remove_cell(Index cell) { is_alive_[cell] = false; }

  //! Divides every cell that has the simplex at a vertex lying on it.
  void split(const Simplex& simplex, Index vertex);

  //! The triangles at a vertex that belong to one cell only, in no particular but a fixed order.
  std::vector<Simplex> boundary_faces_at(Index vertex) const;

  //! Vertices of no cell are kept.
  DomainMesh<3> to_mesh() const;

 private:
  void add_cell(const Corners& corners);

  std::vector<Vector<3>> points_;
  std::vector<Corners> cells_;
  std::vector<bool> is_alive_;
  std::vector<std::vector<Index>> cells_at_;  // per vertex, removed ones included
};

}  // namespace flbc

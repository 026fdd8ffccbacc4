// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/openmesh/domain.h"

namespace flbc::openmesh {
namespace {

// The row of a vertex in a cell of either mesh.
Index corner_of(const CellList<3>& cells, Index cell, Index vertex) {
  Index corner = 0;
  while (cells(corner, cell) != vertex) ++corner;
  return corner;
}

}  // namespace

Domain<3> make_domain(const TetMesh& mesh) {
  Domain<3> domain;
  domain.mesh = mesh.domain();
  normalize_and_validate(domain.mesh);

  const auto num_faces = static_cast<Eigen::Index>(mesh.n_faces());
  auto& topology = domain.topology;
  topology.facets.resize(3, num_faces);
  topology.sides.resize(2, num_faces);
  topology.cell_facets.resize(4, domain.mesh.num_cells());
  for (const auto cell : mesh.cells()) {
    // A reversed cell has its vertices in another order than the mesh.
    const auto vertices = mesh.cv_range(cell);
    const auto faces = mesh.cf_range(cell);
    for (std::size_t k = 0; k < 4; ++k) {
      const Index row = corner_of(domain.mesh.cells, cell.idx(), vertices[k].idx());
      topology.cell_facets(row, cell.idx()) = faces[k].idx();
    }
  }
  for (const auto face : mesh.faces()) {
    const auto sides = mesh.fc_range(face);
    const Index first = sides[0].idx();
    topology.sides.col(face.idx()) << first, (sides.size() == 2 ? sides[1].idx() : -1);
    // In the order of the vertices of the first cell, as in build_topology().
    Index row = 0;
    for (Index k = 0; k < 4; ++k) {
      if (topology.cell_facets(k, first) == face.idx()) continue;
      topology.facets(row++, face.idx()) = domain.mesh.cells(k, first);
    }
  }
  return domain;
}

}  // namespace flbc::openmesh

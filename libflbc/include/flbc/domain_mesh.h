// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! The mesh of the cage's interior on which the coordinates are piecewise linear.
#pragma once

#include <vector>

#include "flbc/types.h"

namespace flbc {

//! Triangles (2D) or tetrahedra (3D) that fill the interior of a cage.
template <int Dim>
struct DomainMesh {
  PointList<Dim> points;  //!< Dim x V
  CellList<Dim> cells;    //!< (Dim + 1) x F, positively oriented

  //! V.
  Index num_vertices() const { return static_cast<Index>(points.cols()); }

  //! F.
  Index num_cells() const { return static_cast<Index>(cells.cols()); }
};

//! The facets (edges in 2D, triangles in 3D) of a domain mesh and which cells they separate.
template <int Dim>
struct MeshTopology {
  //! Dim x E, the vertices of each facet.
  FacetList<Dim> facets;

  //! 2 x E, the cells on the first and second side; the second is -1 on the boundary.
  Eigen::Matrix<Index, 2, Eigen::Dynamic> sides;

  //! (Dim + 1) x F, row k: the facet opposite to the cell's vertex k.
  CellList<Dim> cell_facets;

  //! E.
  Index num_facets() const { return static_cast<Index>(facets.cols()); }

  //! Whether the facet has a cell on one side only.
  bool is_boundary(Index facet) const { return sides(1, facet) < 0; }
};

//! Enumerates facets in the order in which the cells first meet them.
//! \param mesh  with indices in range
//! \throws InputError if a facet belongs to more than two cells
template <int Dim>
MeshTopology<Dim> build_topology(const DomainMesh<Dim>& mesh);

//! Which vertices lie on boundary facets.
//! \param topology  of a mesh
//! \param num_vertices  V of that mesh
//! \return V entries
template <int Dim>
std::vector<bool> boundary_vertices(const MeshTopology<Dim>& topology, Index num_vertices);

//! Signed area (2D) or volume (3D) of a cell, positive for the orientation demanded here.
//! \param mesh  with indices in range
//! \param cell  in [0, F)
//! \return in units of the mesh^Dim
template <int Dim>
double signed_measure(const DomainMesh<Dim>& mesh, Index cell);

//! Turns cells with negative measure round, and checks the mesh.
//! \param mesh  any
//! \throws InputError naming the element if the mesh is empty, an index is out of range, a number
//! is not finite, a cell has no measure, a vertex belongs to no cell, a facet to more than two
//! cells or to two on the same side of it, or parts touch without a common facet. The mesh may
//! have several parts that do not touch (mesh_parts.h).
template <int Dim>
void normalize_and_validate(DomainMesh<Dim>& mesh);

}  // namespace flbc

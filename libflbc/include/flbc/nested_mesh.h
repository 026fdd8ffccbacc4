// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Uniform refinement of domain meshes. A solve on a refined mesh starts from its coarse mesh.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "flbc/domain_mesh.h"

namespace flbc {

//! Cuts every triangle into 4 and every tetrahedron into 8 at the midpoints of its edges. Vertices
//! keep their indices, and midpoints follow. The parts of a cell follow each other: for each of its
//! corners the part there, which has the corner and midpoints at the places of the cell's corners;
//! then those inside. The octahedron inside a tetrahedron is cut along its shortest diagonal.
//! \param mesh  valid
template <int Dim>
DomainMesh<Dim> refine(const DomainMesh<Dim>& mesh);

//! Number of vertices after refine(): those of the mesh and one per edge.
template <int Dim>
Index refined_vertices(const DomainMesh<Dim>& mesh);

//! The mesh from which refine() made another one.
template <int Dim>
struct CoarseMesh {
  DomainMesh<Dim> mesh{};
  //! For each vertex of the refined mesh, the two ends of its edge; the same vertex twice if it is
  //! a vertex of the coarse mesh.
  std::vector<std::array<Index, 2>> ends{};
};

//! Recognizes a refined mesh by the order of its vertices and cells. It therefore stays one when it
//! is moved, or written and read.
//! \param mesh  valid
//! \return nothing if the mesh is not refined, or a coarse cell is inverted or far smaller than its
//! parts, because the mesh was moved
template <int Dim>
std::optional<CoarseMesh<Dim>> coarse_mesh(const DomainMesh<Dim>& mesh);

}  // namespace flbc

// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! The connected parts of a domain mesh.
#pragma once

#include <vector>

#include "flbc/domain_mesh.h"

namespace flbc {

//! A connected part of a mesh.
template <int Dim>
struct MeshPart {
  DomainMesh<Dim> mesh;
  std::vector<Index> vertices;  //!< per vertex of the part: its number in the whole mesh
};

//! Number of parts that share no vertex.
//! \param mesh  has passed normalize_and_validate()
template <int Dim>
Index count_parts(const DomainMesh<Dim>& mesh);

//! Takes a mesh apart. Vertices and cells of a part keep their order.
//! \param mesh  has passed normalize_and_validate()
//! \return in the order of their first vertices
template <int Dim>
std::vector<MeshPart<Dim>> mesh_parts(const DomainMesh<Dim>& mesh);

//! Puts parts together again, the cells of one after those of the other.
//! \param parts  whose lists of vertices hold each number from 0 to V - 1 once
template <int Dim>
DomainMesh<Dim> join_parts(const std::vector<MeshPart<Dim>>& parts);

//! Refuses meshes of several parts.
//! \param mesh  has passed normalize_and_validate()
//! \throws InputError that names a vertex of each of two parts
template <int Dim>
void require_connected(const DomainMesh<Dim>& mesh);

}  // namespace flbc

// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Meshes the interior of a cage by the first mesher that can.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "flbc/meshing.h"

namespace flbc {

//! A mesher and its name, for reports.
template <int Dim>
struct NamedMesher {
  std::string name;
  PartMesher<Dim> mesh;
};

//! Meshers of a program (linked_meshers.h).
template <int Dim>
struct Meshers {
  std::vector<NamedMesher<Dim>> in_order{};  //!< in which they are tried
  //! Refuses a cage that crosses itself, by an InputError that names the place; may be empty.
  std::function<void(const Cage<Dim>&)> check{};
};

//! A mesh and how it was made.
template <int Dim>
struct MadeDomain {
  DomainMesh<Dim> mesh{};
  std::string mesher{};  //!< the last one that had to be tried, if the cage has several parts
  std::string note{};    //!< what differs from the request: mesher, number of vertices; or empty
};

//! Number of vertices of a domain mesh if none is given.
constexpr Index kDefaultVertices = 10000;

//! Meshes each part of the interior of a cage. If a mesher fails, the next one is tried. Where
//! quality needs more vertices than wanted, the mesh has as few as possible.
//! \param cage  n control points, valid; without a check free of self-intersections
//! \param options  of the whole mesh, see mesh_in_parts()
//! \param meshers  at least one
//! \throws OptionError if there is no mesher, or no mesher supports the options; InputError with
//! the reasons of all meshers
template <int Dim>
MadeDomain<Dim> make_domain(const Cage<Dim>& cage, const MeshingOptions<Dim>& options,
                            const Meshers<Dim>& meshers);

}  // namespace flbc

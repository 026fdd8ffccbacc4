// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Meshes the interior of a cage by the first mesher that can, of those that a program links.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "flbc/errors.h"
#include "flbc/meshing.h"

namespace flbc {

//! A mesher and its name, for reports.
template <int Dim>
struct NamedMesher {
  std::string name;
  PartMesher<Dim> mesh;
};

//! Meshers of a program (linked_meshers()).
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

namespace internal {

// CMake defines these for targets that link flbc::cgal, flbc::tetgen, or flbc::netgen.
#ifdef FLBC_LINKS_CGAL
constexpr bool kLinksCgal = true;
#else
constexpr bool kLinksCgal = false;
#endif
#ifdef FLBC_LINKS_TETGEN
constexpr bool kLinksTetgen = true;
#else
constexpr bool kLinksTetgen = false;
#endif
#ifdef FLBC_LINKS_NETGEN
constexpr bool kLinksNetgen = true;
#else
constexpr bool kLinksNetgen = false;
#endif

}  // namespace internal

//! CGAL in 2D; TetGen, then Netgen in 3D. With CGAL, facets that cross are named, of which 3D
//! meshers only say that they are there. Without CMake, define FLBC_LINKS_CGAL, FLBC_LINKS_TETGEN,
//! or FLBC_LINKS_NETGEN.
//! \tparam kCgal, kTetgen, kNetgen  leave them out; they distinguish parts of a program that link
//! different components
template <int Dim, bool kCgal = internal::kLinksCgal, bool kTetgen = internal::kLinksTetgen,
          bool kNetgen = internal::kLinksNetgen>
Meshers<Dim> linked_meshers() {
  Meshers<Dim> meshers;
#ifdef FLBC_LINKS_CGAL
  if constexpr (kCgal) {
    meshers.check = [](const Cage<Dim>& cage) {
      validate(cage);
      const auto defects = find_self_intersections(cage, 1);
      if (!defects.empty()) throw InputError(defects.front().message);
    };
    if constexpr (Dim == 2) meshers.in_order.push_back({"cgal", triangulate});
  }
#endif
#ifdef FLBC_LINKS_TETGEN
  if constexpr (Dim == 3 && kTetgen) meshers.in_order.push_back({"tetgen", tetrahedralize});
#endif
#ifdef FLBC_LINKS_NETGEN
  if constexpr (Dim == 3 && kNetgen) {
    meshers.in_order.push_back({"netgen", tetrahedralize_by_netgen});
  }
#endif
  return meshers;
}

}  // namespace flbc

// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! The meshers of the components that a program links.
#pragma once

#include <functional>

#include "flbc/coarse_to_fine.h"
#include "flbc/meshing.h"
#ifdef FLBC_LINKS_TETGEN
#endif
#ifdef FLBC_LINKS_CGAL
#endif

namespace flbc::openmesh {

//! Makes the mesh of a cage's interior, as triangulate() and tetrahedralize() do.
template <int Dim>
using Mesher = std::function<DomainMesh<Dim>(const Cage<Dim>&, const MeshingOptions<Dim>&)>;

namespace internal {

// Defined by CMake for targets that link flbc::openmesh and flbc::cgal or flbc::tetgen.
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
template <int Dim>
constexpr bool kLinksMesher = Dim == 2 ? kLinksCgal : kLinksTetgen;

//! Coarser meshes by a mesher, about as fine as asked and within a minute; none without a mesher.
template <int Dim>
CoarseMesher<Dim> coarse_mesher(Mesher<Dim> mesher);

//! The mesher that the program links; empty if it links none.
//! \tparam kLinked  whether it does: parts of a program that differ in it get functions of their own
template <int Dim, bool kLinked = kLinksMesher<Dim>>
Mesher<Dim> linked_mesher() {
#ifdef FLBC_LINKS_CGAL
  if constexpr (Dim == 2 && kLinked) return triangulate;
#endif
#ifdef FLBC_LINKS_TETGEN
  if constexpr (Dim == 3 && kLinked) return tetrahedralize;
#endif
  return {};
}

}  // namespace internal

}  // namespace flbc::openmesh

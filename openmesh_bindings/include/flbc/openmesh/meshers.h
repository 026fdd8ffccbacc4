// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! The meshers of the linked components.
#pragma once

#include <functional>

#include "flbc/errors.h"
#include "flbc/meshing.h"

namespace flbc::openmesh {

//! Makes a domain mesh, such as triangulate() or tetrahedralize().
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

//! The linked mesher; empty if no component is linked. With CGAL, facets that cross are named, of
//! which TetGen only says that they are there, or crashes.
//! \tparam kLinked, kNames  whether the mesher and CGAL are linked; they distinguish parts of a
//! program with different components
template <int Dim, bool kLinked = kLinksMesher<Dim>, bool kNames = kLinksCgal>
Mesher<Dim> linked_mesher() {
#ifdef FLBC_LINKS_CGAL
  if constexpr (Dim == 2 && kLinked) return triangulate;
#endif
#ifdef FLBC_LINKS_TETGEN
  if constexpr (Dim == 3 && kLinked) {
    return [](const Cage<3>& cage, const MeshingOptions<3>& options) {
#ifdef FLBC_LINKS_CGAL
      if (const auto defects = find_self_intersections(cage, 1); !defects.empty())
        throw InputError(defects.front().message);
#endif
      return tetrahedralize(cage, options);
    };
  }
#endif
  return {};
}

}  // namespace internal

}  // namespace flbc::openmesh

// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! The meshers of the components that a program links.
#pragma once

#include "flbc/errors.h"
#include "flbc/make_domain.h"

namespace flbc {

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

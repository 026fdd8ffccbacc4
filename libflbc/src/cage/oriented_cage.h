// SPDX-License-Identifier: BSD-3-Clause
// Cages oriented so that the interior is on the same side of all facets.
#pragma once

#include <vector>

#include "flbc/cage.h"

namespace flbc {

//! A cage with its parts.
template <int Dim>
struct OrientedCage {
  //! Outer loops are counterclockwise, and outer shells have outward normals; holes and cavities
  //! have the opposite orientation.
  Cage<Dim> cage;
  std::vector<Index> shell_of_facet;  //!< loop or shell of each facet, in the order of facets
  std::vector<bool> is_hole;          //!< per shell: whether an odd number of others enclose it
  double measure = 0;                 //!< area (2D) or volume (3D) of the interior, > 0
};

//! \param cage  has passed validate() and does not intersect itself
template <int Dim>
OrientedCage<Dim> orient(const Cage<Dim>& cage);

}  // namespace flbc

// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Repairs defective cages. Implemented in the optional component `caging`.
#pragma once

#include <string>
#include <vector>

#include "flbc/cage.h"

namespace flbc {

//! Outcome of a repair.
template <int Dim>
struct RepairedCage {
  Cage<Dim> cage;                    //!< passes validate() and does not intersect itself
  std::vector<std::string> changes;  //!< one sentence each, with the original numbers
  std::vector<Index> new_numbers;    //!< per original control point; -1: removed
  bool keeps_numbers = true;         //!< all control points keep their numbers
  bool is_wrapped = false;           //!< all facets are new, and each control point has the
                                     //!< number of the nearest original one
  double measure_before = 0;         //!< area (2D) or volume (3D) that the original bounds, as the
                                     //!< union of its parts; 0: it is open, unless it
                                     //!< is wrapped, where it is an estimate
  double max_distance = 0;           //!< of the new surface from the original one; 0: below 1e-6 of
                                     //!< cage size
  Index kept = 0;                    //!< original control points that are still there
};

//! Repairs a cage in this order:
//! 1. merges coincident control points, and splits facets at control points that lie on their
//!    edges. If the cage is open, points farther apart are merged where this closes it, up to a
//!    tenth of the shortest edge;
//! 2. removes degenerate, duplicate, and dangling facets;
//! 3. orients facets consistently, and closes holes;
//! 4. if facets still cross, touch, or branch: cuts them where they meet, removes what has the
//! inside
//!    on both sides, and separates solids that touch only at control points or edges. The result is
//!    the union of crossing and touching parts;
//! 5. if a defect remains: wraps the cage closely as in cage_from_model(), with more control points
//!    where it needs them.
//!
//! Control points that belong to no facet are removed.
//! \param cage  facet indices in range
//! \throws InputError if the cage cannot be repaired; the message names the defect
template <int Dim>
RepairedCage<Dim> repair_cage(const Cage<Dim>& cage);

}  // namespace flbc

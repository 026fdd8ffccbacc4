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
};

//! Merges coincident control points, removes degenerate and duplicate facets and dangling facets,
//! orients facets consistently, closes holes, and removes unreferenced control points. If the cage
//! still intersects itself or is not manifold, it is replaced by a close wrap as in
//! cage_from_model().
//! \param cage  facet indices in range
//! \throws InputError if the cage cannot be repaired; the message names the defect
template <int Dim>
RepairedCage<Dim> repair_cage(const Cage<Dim>& cage);

}  // namespace flbc

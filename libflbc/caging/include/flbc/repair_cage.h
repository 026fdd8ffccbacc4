// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Repairs defective cages. Implemented by the optional component `caging`.
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
  std::vector<Index> new_numbers;    //!< of the control points; -1: removed
  bool keeps_numbers = true;         //!< all control points keep their numbers
  bool is_wrapped = false;           //!< all facets are new, and each control point has the
                                     //!< number of the nearest original one
};

//! Merges control points that coincide, drops degenerate and duplicate facets and flaps
//! that hang on others, orients the facets alike, closes holes, and drops unreferenced
//! control points. If the cage still intersects itself or is not manifold, it is wrapped closely:
//! see cage_from_model().
//! \param cage  numbers of control points in range
//! \throws InputError if nothing helps; the message names the defect
template <int Dim>
RepairedCage<Dim> repair_cage(const Cage<Dim>& cage);

}  // namespace flbc

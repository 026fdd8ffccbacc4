// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! From a defective cage to a sound one. Implemented by the optional component `cgal`.
#pragma once

#include <string>
#include <vector>

#include "flbc/cage.h"

namespace flbc {

//! Outcome of a repair.
template <int Dim>
struct RepairedCage {
  Cage<Dim> cage;                    //!< passes validate() and does not intersect itself
  std::vector<std::string> changes;  //!< a sentence each, with the numbers there were
  std::vector<Index> new_numbers;    //!< of the control points; -1: has gone
  bool keeps_numbers = true;         //!< all control points have the numbers they had
  bool is_wrapped = false;           //!< the facets are all new, and control points have the
                                     //!< numbers of those that came to lie nearest to them
};

//! Merges control points that coincide, drops facets that are degenerate or there twice and flaps
//! that hang on others, orients the facets alike, closes holes, and drops control points of no
//! facet. A cage that is defective still, because it intersects itself or is not manifold, is
//! wrapped closely: see cage_from_model().
//! \param cage  numbers of control points in range
//! \throws InputError if nothing helps: the message says what is wrong with the cage
template <int Dim>
RepairedCage<Dim> repair_cage(const Cage<Dim>& cage);

}  // namespace flbc

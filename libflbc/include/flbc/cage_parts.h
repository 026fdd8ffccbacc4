// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! The parts of a cage whose interior is not connected.
#pragma once

#include <vector>

#include "flbc/cage.h"

namespace flbc {

//! A connected part of a cage's interior: an outer loop or shell with the holes or cavities in it.
template <int Dim>
struct CagePart {
  Cage<Dim> cage;                     //!< control points and facets in the order of the whole cage
  std::vector<Index> control_points;  //!< per control point: its number there, ascending
};

//! Takes a cage apart. A loop or shell in a hole of another one is a part of its own.
//! \param cage  has passed validate() and does not intersect itself
//! \return at least one, in the order of their first control points
template <int Dim>
std::vector<CagePart<Dim>> cage_parts(const Cage<Dim>& cage);

}  // namespace flbc

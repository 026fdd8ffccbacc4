// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Where a cage intersects itself. Implemented by the optional component `cgal`.
#pragma once

#include <vector>

#include "flbc/cage.h"

namespace flbc {

//! Pairs of facets that meet elsewhere than in common vertices or edges. Component `cgal`.
//! \param cage  has passed validate()
//! \param limit  largest number of defects to look for
//! \return at most `limit` defects
template <int Dim>
std::vector<Defect> find_self_intersections(const Cage<Dim>& cage, std::size_t limit = 16);

}  // namespace flbc

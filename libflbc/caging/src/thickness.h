// SPDX-License-Identifier: BSD-3-Clause
// How thick a surface is at its vertices.
#pragma once

#include <vector>

#include "flbc/cage.h"

namespace flbc {

//! At each vertex, the distance to the opposite side: the second largest over rays in a cone around
//! the inward normal, similar to the shape diameter of Shapira, Shamir and Cohen-Or ("Consistent
//! mesh partitioning and skeletonisation using the shape diameter function", 2008).
//! \param surface  closed, with outward normals
//! \return of every vertex; the size of the surface where most rays find no other side
std::vector<double> thickness_of(const Cage<3>& surface);

}  // namespace flbc

// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Maximum entropy coordinates, for comparison.
#pragma once

#include "flbc/cage.h"

namespace flbc {

//! Maximum entropy coordinates (Hormann and Sukumar 2008) with the priors of their first kind. They
//! are positive, reproduce linear functions, are linear on cage facets, and smooth inside, also in
//! concave cages. They are not local. Each point needs a convex minimization in Dim unknowns, and
//! no mesh.
//! The result does not depend on the number of threads.
//! \param cage  valid and free of self-intersections; may have holes, in any orientation
//! \param points  Dim x P, finite, inside the cage or outside by at most kBoundaryTolerance
//! \return n x P, each column sums to 1
//! \throws InputError naming the first point that is not finite or outside the cage
template <int Dim>
WeightMatrix maximum_entropy_coordinates(const Cage<Dim>& cage, const PointList<Dim>& points);

}  // namespace flbc

// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Maximum likelihood coordinates, for comparison.
#pragma once

#include "flbc/cage.h"

namespace flbc {

//! Maximum likelihood coordinates (Chang, Deng and Hormann 2023), without their optional scaling by
//! distances. They are non-negative, reproduce linear functions, are linear on cage facets, and
//! smooth inside, also in concave cages. They are not local. Each point needs a convex minimization
//! in Dim unknowns, and no mesh. In 3D, the paper has no proof that the minimum exists in every
//! concave cage.
//! The result does not depend on the number of threads.
//! \param cage  valid and free of self-intersections; may have holes, in any orientation
//! \param points  Dim x P, finite, inside the cage or outside by at most kBoundaryTolerance
//! \return n x P, each column sums to 1
//! \throws InputError naming the first point that is not finite, is outside the cage, or has no
//! such coordinates
template <int Dim>
WeightMatrix maximum_likelihood_coordinates(const Cage<Dim>& cage, const PointList<Dim>& points);

}  // namespace flbc

// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Mean value coordinates, in closed form, for comparison.
#pragma once

#include "flbc/cage.h"

namespace flbc {

//! Mean value coordinates (Floater 2003, equation 2.1; Hormann and Floater 2006 for arbitrary
//! polygons; Ju, Schaefer and Warren 2005 for triangle meshes). They reproduce linear functions,
//! are linear on cage facets, and smooth elsewhere. They are not local, and can be negative if the
//! cage is not convex. They need no mesh and are also defined outside the cage. The result is
//! accurate to rounding everywhere, even near facets, edges, control points, and the planes of
//! facets. A point within 1e-12 of cage size from the cage is first moved to the nearest point of
//! the cage. The result does not depend on the number of threads.
//! \param cage  valid and free of self-intersections; may have holes and several parts, in any
//! orientation
//! \param points  Dim x P, finite
//! \return n x P, each column sums to 1
//! \throws InputError naming the first non-finite point
template <int Dim>
WeightMatrix mean_value_coordinates(const Cage<Dim>& cage, const PointList<Dim>& points);

}  // namespace flbc

// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Mean value coordinates: coordinates in closed form, for comparison.
#pragma once

#include "flbc/cage.h"

namespace flbc {

//! Mean value coordinates (Floater 2003; Hormann and Floater 2006 for arbitrary polygons; Ju,
//! Schaefer and Warren 2005 for triangle meshes). They reproduce linear functions, are linear on
//! the cage's facets and smooth elsewhere, but neither local nor non-negative where the cage is not
//! convex. They need no mesh and are defined outside the cage as well. Accurate to rounding
//! everywhere, in particular near facets, edges and control points and near the planes of facets. A
//! point nearer to the cage than 1e-12 of its size counts as its nearest place on the cage. Points
//! are treated in parallel; the result does not depend on the number of threads.
//! \param cage  has passed validate() and does not intersect itself; may have holes and several
//!     parts, in any orientation
//! \param points  Dim x P, finite
//! \return n x P, each column sums to 1
//! \throws InputError naming the first point that is not finite
template <int Dim>
WeightMatrix mean_value_coordinates(const Cage<Dim>& cage, const PointList<Dim>& points);

}  // namespace flbc

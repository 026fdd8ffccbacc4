// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Blended barycentric coordinates, for comparison.
#pragma once

#include "flbc/cage.h"

namespace flbc {

//! Blended barycentric coordinates (Anisimov, Panozzo and Hormann 2017), in 2D: mean value
//! coordinates of the quadrilaterals of a constrained Delaunay triangulation, blended in each
//! triangle. They are non-negative, reproduce linear functions, are linear on cage edges, and have
//! continuous first derivatives inside. At most 6 weights of a point are positive, those of
//! neighboring triangles. They are in closed form, and depend on the triangulation.
//! \param cage  valid and free of self-intersections; may have holes and several parts, in any
//! orientation
//! \param points  2 x P, finite, inside the cage or outside by at most kBoundaryTolerance
//! \return n x P, each column sums to 1
//! \throws InputError naming the first point that is not finite or outside the cage; also if the
//! cage intersects itself and has no triangulation
WeightMatrix blended_coordinates(const Cage<2>& cage, const PointList<2>& points);

}  // namespace flbc

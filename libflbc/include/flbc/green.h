// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Green coordinates, for comparison.
#pragma once

#include "flbc/cage.h"

namespace flbc {

//! Green coordinates (Lipman, Levin and Cohen-Or 2008), in closed form: the weights of the n
//! control points and of the m unit normals of the facets, by Green's third identity. They
//! reproduce similarities, and in 2D all deformations are conformal. They are not local, may be
//! negative, and do not interpolate: points on the cage leave it when it is deformed.
//! To deform points, pass the weights and control_points_and_normals() of a pose to deform().
//! \param cage  valid and free of self-intersections, n control points and m facets; may have holes
//! and several parts, in any orientation. All parts influence all points
//! \param points  Dim x P, finite, inside the cage or outside by at most kBoundaryTolerance, which
//! get the limit from inside. The result does not depend on the number of threads
//! \return (n + m) x P: weights of the control points, which sum to 1, and weights of the normals
//! in the units of the cage
//! \throws InputError naming the first point that is not finite or outside the cage
template <int Dim>
WeightMatrix green_coordinates(const Cage<Dim>& cage, const PointList<Dim>& points);

//! The control points of a pose, and the outward unit normals of its facets times their stretch
//! relative to the rest cage: that of its length in 2D, and in 3D that of the paper, which measures
//! angles too.
//! \param cage  at rest, as for green_coordinates()
//! \param pose  Dim x n, control points in any units
//! \return Dim x (n + m)
//! \throws InputError if the numbers of control points differ
template <int Dim>
PointList<Dim> control_points_and_normals(const Cage<Dim>& cage, const PointList<Dim>& pose);

}  // namespace flbc

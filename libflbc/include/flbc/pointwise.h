// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Coordinates for comparison that need no domain mesh, by the names of their methods.
#pragma once

#include "flbc/cage.h"
#include "flbc/options.h"
#include "flbc/placement.h"
#include "flbc/sparse_weights.h"

namespace flbc {

//! Whether a method computes the weights of each point on its own, without a domain mesh.
bool is_pointwise(Method method);

//! Coordinates at any points of the interior. If the cage has several parts, a point has weights
//! for the control points of its part only, as in solve().
//! \param cage  valid and free of self-intersections
//! \param points  Dim x P, finite, in the units of the cage
//! \param method  one with is_pointwise()
//! \return n x P, each column sums to 1
//! \throws OptionError if the method is not pointwise, or not available in this dimension;
//! InputError naming the first point without coordinates
template <int Dim>
WeightMatrix pointwise_coordinates(const Cage<Dim>& cage, const PointList<Dim>& points,
                                   Method method);

//! Coordinates of placed points.
//! \param placement  of P points, with or without a mesh, which is not used
//! \param options  method, threads, and non_negative, of which kProject applies to points inside
//! \return n x P
//! \throws as above; also as project_non_negative()
template <int Dim>
SparseWeights pointwise_coordinates(const Cage<Dim>& cage, const Placement<Dim>& placement,
                                    const SolverOptions& options);

}  // namespace flbc

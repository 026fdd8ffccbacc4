// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Few influences per point such that neighbours agree on how the deformation changes.
#pragma once

#include <vector>

#include "flbc/edge_list.h"
#include "flbc/sparsify.h"
#include "flbc/types.h"

namespace flbc {

//! Makes weights sparse as sparsify() does, under the same constraints and with the same exactness,
//! but not point by point: what becomes least is the error of the differences along the edges, so
//! that no seams appear where neighbours keep different influences (after Landreneau and Schaefer,
//! "Poisson-Based Weight Reduction of Animated Meshes", 2010; there influences are dropped in the
//! order of their cost). With d_a the new less the given weights of point a and C_p pose p, it is
//!
//!     mean_p ( sum_ab k_ab |C_p (d_a - d_b)|^2 + sum_a m_a / r^2 |C_p d_a|^2 )
//!
//! over edges ab and points a, with m_a = sum_b k_ab |x_a - x_b|^2 / 2 and r a twentieth of the
//! size of the points, or five edges of mean length if that is more: the second term is small and
//! keeps points in their places. To the mean over the given poses a tenth of what a pose of
//! independent_poses() and one of smooth_poses() cost together on average is added, for the control
//! points that the given ones do not move; without given poses all of that is what counts.
//!
//! Found by block coordinate descent: point by point, a row's weights are exchanged for the best
//! ones while its neighbours are fixed. The result is a local minimum, and not above what
//! sparsify() gives. Points without edges get the weights of sparsify(), points given with at most
//! Dim influences keep them, since these lie on the cage and follow its facet; points that coincide
//! and have the same weights are given the same. The same result for any number of threads.
//! \param control_points  Dim x n, finite
//! \param points  Dim x P, inside the convex hull of the control points, in their units
//! \param edges  between the points, weights of any unit
//! \param weights  n x P, as for sparsify()
//! \param poses  Dim x n each, displaced control points, may be empty
//! \param options  as for sparsify()
//! \return n x P
//! \throws OptionError and InputError as sparsify(), InputError also for edges and poses that do
//! not fit
template <int Dim>
WeightMatrix reduce_by_poisson(const PointList<Dim>& control_points, const PointList<Dim>& points,
                               const EdgeList& edges, const WeightMatrix& weights,
                               const std::vector<PointList<Dim>>& poses,
                               const SparsifyOptions& options);

//! The energy that reduce_by_poisson() minimises, for any weights, with displacements in units of a
//! tenth of the cage's size.
//! \param control_points  Dim x n, finite
//! \param points  Dim x P
//! \param edges  between the points
//! \param before  n x P, the weights given
//! \param after  n x P, the weights to judge
//! \param poses  Dim x n each, may be empty
//! \return >= 0
//! \throws InputError if weights, edges or poses do not fit
template <int Dim>
double poisson_cost(const PointList<Dim>& control_points, const PointList<Dim>& points,
                    const EdgeList& edges, const WeightMatrix& before, const WeightMatrix& after,
                    const std::vector<PointList<Dim>>& poses);

}  // namespace flbc

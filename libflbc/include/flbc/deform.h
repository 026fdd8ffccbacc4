// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Moving a model with its cage: X = C W for any number of poses C. Control points may follow
//! others, or bones.
#pragma once

#include "flbc/sparse_weights.h"

namespace flbc {

//! Deforms points with the control points.
//! \param weights  of P points
//! \param control_points  Dim x n, in any units
//! \param threads  maximum number of threads (0 = as many as OpenMP offers). Fewer than four
//! million nonzero weights always use one thread, because starting others costs more. The result
//! does not depend on it
//! \return Dim x P, in the units of the control points
//! \throws InputError if the numbers of control points differ, with both numbers
template <int Dim>
PointList<Dim> deform(const SparseWeights& weights, const PointList<Dim>& control_points,
                      int threads = 0);

//! The distance that each point moved.
//! \param before  Dim x P
//! \param after  Dim x P, in the same units
//! \return P lengths
//! \throws InputError if the numbers of points differ
template <int Dim>
Eigen::VectorXd displacements(const PointList<Dim>& before, const PointList<Dim>& after);

//! The product of weights and a map, if the n control points themselves follow m others. With
//! weights of the map >= 0 that sum to 1 and reproduce the n control points, the result has the
//! same properties for the P points. reduce_influences() limits the influences, which grow.
//! \param weights  of P points for n control points
//! \param map  weights of the n control points for m others
//! \return weights of P points for m control points
//! \throws InputError if sizes do not match, or naming the first control point whose weights in the
//! map are negative, or sum to 1 with an error above 1e-9
SparseWeights compose(const SparseWeights& weights, const SparseWeights& map);

//! The skin of a model whose cage is skinned by bones: the product of both, >= 0 with sum 1 for
//! each point. Negative products are dropped; they occur with OutsidePoints::kExtend. What remains
//! is scaled.
//! \param weights  of P points for n control points
//! \param bones  weights of the n control points for m bones
//! \param max_influences  the largest are kept for each point; 0 = all
//! \return weights of P points for m bones; points without weights have none
//! \throws OptionError for a negative number; InputError if sizes do not match, or naming the first
//! control point whose weights for bones are negative, or sum to 1 with an error above 1e-6
SparseWeights skin(const SparseWeights& weights, const SparseWeights& bones,
                   Index max_influences = 0);

}  // namespace flbc

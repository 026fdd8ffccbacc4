// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Moving a model with its cage: X = C W for any number of poses C.
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

}  // namespace flbc

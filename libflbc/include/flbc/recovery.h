// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! From gradients to weights.
#pragma once

#include "flbc/lbc_problem.h"

namespace flbc {

//! Read access to gradients of all control points on all cells, stored cell-major, then by
//! component, then `stride` control points contiguous, of which the first n count.
template <class Scalar, int Dim>
struct GradientView {
  const Scalar* data;
  std::size_t stride;
  Index n;

  //! Dim x n, on one cell, in double precision.
  Eigen::Matrix<double, Dim, Eigen::Dynamic> cell(Index s) const {
    using Rows = Eigen::Matrix<Scalar, Dim, Eigen::Dynamic, Eigen::RowMajor>;
    return Eigen::Map<const Rows, 0, Eigen::OuterStride<>>(
               data + static_cast<std::size_t>(s) * Dim * stride, Dim, n,
               Eigen::OuterStride<>(static_cast<Eigen::Index>(stride)))
        .template cast<double>();
  }
};

//! The paper's recovery (4.2.2): breadth-first search from the boundary divides the vertices into
//! levels; the weights of a level follow from the level before, w(v) = w(v') + g (v - v'), in
//! parallel. Where several edges lead to a vertex, and several cells lie at an edge, their values
//! are averaged in a fixed order.
//! \return n x V
template <class Scalar, int Dim>
WeightMatrix integrate_breadth_first(const LbcProblem<Dim>& problem,
                                     const GradientView<Scalar, Dim>& gradients);

//! The weights whose gradients are nearest to the given ones in the mean over the domain: one
//! Poisson problem with the known boundary values. Equal to breadth-first integration where the
//! gradients are integrable, and free of its dependence on paths where they are not quite yet.
//! \return n x V \throws SolverError
template <class Scalar, int Dim>
WeightMatrix integrate_least_squares(const LbcProblem<Dim>& problem,
                                     const GradientView<Scalar, Dim>& gradients);

//! Harmonic coordinates (Joshi et al. 2007) on the same mesh. \return n x V \throws SolverError
template <int Dim>
WeightMatrix harmonic_coordinates(const LbcProblem<Dim>& problem);

}  // namespace flbc

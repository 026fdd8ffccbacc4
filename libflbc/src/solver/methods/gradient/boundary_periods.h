// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Constraints that the paper's gradient problem lacks on domains with holes.
#pragma once

#include <vector>

#include "flbc/lbc_problem.h"
#include "flbc/types.h"
#include "linear/linear_solver.h"

namespace flbc::gradient {

//! If the boundary has several components (a hole in 2D, a cavity in 3D), (8)-(10) determine the
//! weights on each component only up to a constant. The gradients determine differences along a
//! component, but not between components. For each component after the first, let psi be the
//! harmonic function that is 1 on it and 0 on the others. Then every integrable gradient g with the
//! right boundary values satisfies
//!   sum_s A_s grad psi(s) . g_i(s) = sum over boundary vertices v of w_i(v) (K psi)(v),
//! one more linear constraint, which determines the constant.
template <int Dim>
struct Period {
  PointList<Dim> field;    //!< Dim x F, A_s grad psi(s), scaled to norm 1 over all cells
  Eigen::VectorXd values;  //!< n, the right-hand side for each control point, scaled equally
};

//! One period for each boundary component after the first; empty for a connected boundary.
//! \param solver  for psi: kDirect, or any other for multigrid
template <int Dim>
std::vector<Period<Dim>> boundary_periods(const LbcProblem<Dim>& problem,
                                          LinearSolver solver = LinearSolver::kDirect);

}  // namespace flbc::gradient

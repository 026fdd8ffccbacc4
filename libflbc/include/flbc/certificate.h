// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Bounds the distance of weights from the optimum by duality.
#pragma once

#include "flbc/lbc_problem.h"
#include "flbc/sparse_weights.h"

namespace flbc {

//! Bound on the optimality gap of weights, by weak duality.
struct Certificate {
  double objective = 0;     //!< of the weights after projection onto the feasible set
  double lower_bound = 0;   //!< on the objective of all feasible, non-negative weights
  double relative_gap = 0;  //!< (objective - lower_bound) / objective
};

//! The Lagrangian dual function, a lower bound on the objective. For every cell field p, the
//! objective of any feasible w is at least
//!
//!     sum_s sum_i p_s^i . grad w_i - C(p) = sum_v sum_i w_i(v) (D p_i)(v) - C(p),
//!     (D p_i)(v) = sum over the cells s at v of p_s^i . grad(lambda_v),
//!     C(p) = sum_s sum_i A_s max(|p_s^i| / A_s - phi_s^i, 0)^2 / (2 epsilon).
//!
//! With smoothness epsilon = 0, C(p) is 0 for |p_s^i| <= phi_s^i A_s, and longer vectors are
//! shortened.
//! Boundary vertices contribute fixed terms. Every interior vertex contributes at least the value
//! of the linear program min { omega . D p(v) : omega >= 0, sum omega = 1, sum omega c = x_v }.
//! The bound holds for all arguments. It accounts for rounding in the flux, the sums, and the
//! linear programs, but not in the hat gradients and measures (1e-16 to 1e-15 relative,
//! docs/explanation/method/certificate.md). It is tight if the flux is the dual of a nearly
//! converged solver.
//! \param problem  mesh, phi and boundary values
//! \param flux  p, a vector per cell and control point; non-finite ones count as 0
//! \param weights  of V points, an estimate of the optimum that saves time
//! \return at least 0 and at most objective(problem.mesh, problem.phi, w, problem.smoothness) for
//! all feasible w >= 0
//! \throws InputError if sizes do not fit
template <class Scalar, int Dim>
double lower_bound(const LbcProblem<Dim>& problem, const CellFieldView<Scalar, Dim>& flux,
                   const SparseWeights& weights);

//! Computes the bound and the objective of the weights. Infeasible weights are first projected:
//! boundary columns get their known values, interior columns go through project_non_negative().
//! \param problem  mesh, phi and boundary values
//! \param flux  p, as for lower_bound()
//! \param weights  n x V, finite
//! \return objective and bound in the units of phi times the mesh^(Dim - 1), and their relative gap
//! \throws InputError if sizes do not fit or weights are not finite
template <class Scalar, int Dim>
Certificate certify(const LbcProblem<Dim>& problem, const CellFieldView<Scalar, Dim>& flux,
                    const WeightMatrix& weights);

}  // namespace flbc

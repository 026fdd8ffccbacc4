// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Bounds the distance of weights from the optimum by duality.
#pragma once

#include <memory>

#include "flbc/lbc_problem.h"
#include "flbc/sparse_weights.h"

namespace flbc {

//! What others need to check the certificate of weights, next to cage, mesh, and weights: for these
//! vectors they compute the bound again (scripts/check_certificate.py). Lengths are those of the
//! mesh.
struct Proof {
  //! p / A, without a unit: a row per cell and axis (row s Dim + d), a column per control point.
  Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> flux;
  //! Dim x V: y of an interior vertex, for which its linear program is at least
  //! min_i D p_i(v) - y . (c_i - x_v); zero on the boundary.
  Eigen::MatrixXd multipliers;
  WeightFunctions phi;    //!< n x F
  double smoothness = 0;  //!< epsilon, a length
  //! 2 x K: vertex and control point of each pair whose weight masks fix to 0 (LbcProblem::masks).
  Eigen::Matrix<Index, 2, Eigen::Dynamic> masked{};
};

//! Bound on the optimality gap of weights, by weak duality.
struct Certificate {
  double objective = 0;                  //!< of the weights after projection onto the feasible set
  double lower_bound = 0;                //!< on the objective of all feasible, non-negative weights
  double relative_gap = 0;               //!< (objective - lower_bound) / objective
  std::shared_ptr<const Proof> proof{};  //!< with SolverOptions::certify
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
//! Masked weights are 0, so these programs leave masked control points out.
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
//! \param proof  receives flux and multipliers, in the units of the problem
//! \return objective and bound in the units of phi times the mesh^(Dim - 1), and their relative gap
//! \throws InputError if sizes do not fit or weights are not finite
template <class Scalar, int Dim>
Certificate certify(const LbcProblem<Dim>& problem, const CellFieldView<Scalar, Dim>& flux,
                    const WeightMatrix& weights, Proof* proof = nullptr);

}  // namespace flbc

// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! How far weights can be from the optimum, proved by duality.
#pragma once

#include "flbc/lbc_problem.h"

namespace flbc {

//! Proof of how good weights are, by weak duality (certificate.h).
struct Certificate {
  double objective = 0;     //!< of the weights, made feasible and non-negative where they are not
  double lower_bound = 0;   //!< of the objective of all feasible, non-negative weights
  double relative_gap = 0;  //!< (objective - lower_bound) / objective
};

//! The Lagrangian dual function. For every cell field p with |p_s^i| <= phi_s^i A_s, any feasible w
//! has an objective of at least
//!
//!     sum_s sum_i p_s^i . grad w_i = sum_v sum_i w_i(v) (D p_i)(v),
//!     (D p_i)(v) = sum over the cells s at v of p_s^i . grad(lambda_v),
//!
//! in which boundary vertices contribute what they do and every interior vertex at least the value
//! of the linear program min { omega . D p(v) : omega >= 0, sum omega = 1, sum omega c = x_v }.
//! Valid whatever the arguments are, with the rounding of the flux, of all sums and of the programs
//! counted in; not that of the hat gradients and measures, some 1e-16 to 1e-15 relative
//! (docs/explanation/method/certificate.md). Good if the flux is the dual of a solver that has
//! nearly converged.
//! \param problem  mesh, phi and boundary values
//! \param flux  p, a vector per cell and control point, shortened to phi A where it is longer;
//! vectors that are not finite count as 0
//! \param weights  n x V, a guess at the optimum that saves time
//! \return at least 0 and at most objective(problem.mesh, problem.phi, w) for all feasible w >= 0
//! \throws InputError if sizes do not fit
template <class Scalar, int Dim>
double lower_bound(const LbcProblem<Dim>& problem, const CellFieldView<Scalar, Dim>& flux,
                   const WeightMatrix& weights);

//! The bound together with the objective of the weights, made feasible if they are not: known
//! values on the boundary, interior columns by project_non_negative().
//! \param problem  mesh, phi and boundary values
//! \param flux  p, as for lower_bound()
//! \param weights  n x V, finite
//! \return objective and bound in the units of phi times the mesh^(Dim - 1), and their relative gap
//! \throws InputError if sizes do not fit or weights are not finite
template <class Scalar, int Dim>
Certificate certify(const LbcProblem<Dim>& problem, const CellFieldView<Scalar, Dim>& flux,
                    const WeightMatrix& weights);

}  // namespace flbc

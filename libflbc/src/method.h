// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! What the iterative methods have in common, for solve().
#pragma once

#include <functional>

#include "flbc/lbc_problem.h"
#include "flbc/options.h"
#include "flbc/report.h"
#include "flbc/solver_state.h"

namespace flbc {

//! What a method hands back. Boundary values are exact; interior rows sum to one and reproduce
//! their points up to the method's precision, and may be negative.
struct Outcome {
  WeightMatrix weights;  //!< n x V
  //! Certificate of weights (n x V) from the method's duals.
  std::function<Certificate(const WeightMatrix&)> certify;
};

//! Method::kGradient and kPaper. \param options  resolved \param report  iterations, status,
//! residuals and seconds are filled in \param storage  memory of the state, may be null
template <int Dim>
Outcome solve_by_gradients(const LbcProblem<Dim>& problem, const SolverOptions& options,
                           SolveReport& report, StateStorage* storage);

//! Method::kValue and kLbc2014. Parameters as above.
template <int Dim>
Outcome solve_by_splitting(const LbcProblem<Dim>& problem, const SolverOptions& options,
                           SolveReport& report, StateStorage* storage);

//! Penalties and relaxations without measure take the numbers out of their range, which must never
//! pass for a result. \throws SolverError unless `finite`
void require_finite(bool finite, const SolverOptions& options, const SolveReport& report);

//! Ends the run or tells the caller, after an evaluation of the residuals that `report` holds.
//! Sets the status. \return whether to stop
bool finished(int iteration, const SolverOptions& options, SolveReport& report);

}  // namespace flbc

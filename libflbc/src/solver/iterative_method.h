// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! The interface that solve() has to the iterative methods.
#pragma once

#include <functional>

#include "base/stage_progress.h"
#include "flbc/lbc_problem.h"
#include "flbc/options.h"
#include "flbc/report.h"
#include "flbc/solver.h"
#include "flbc/solver_state.h"
#include "solver/gap_criterion.h"
#include "solver/supports/cold_start.h"
#include "solver/warm_start/transfer.h"

namespace flbc {

//! The result of a method. Boundary values are exact; interior rows sum to one and reproduce
//! their points up to the method's precision, and may be negative.
struct MethodResult {
  WeightMatrix weights;  //!< n x V, empty if they are sparse
  //! Certificate of weights (n x V) from the method's duals.
  std::function<Certificate(const WeightMatrix&)> certify;
  SparseWeights sparse{};  //!< of V points, from an iteration on supports

  bool is_sparse() const { return sparse.num_points() > 0; }
};

//! A method's result and how it went.
struct MethodRun {
  MethodResult result;
  SolveReport report;
};

//! Whether a method can start from weights and duals found elsewhere.
inline bool inherits(Method method) {
  return method == Method::kValue || method == Method::kGradient || method == Method::kLbc2014;
}

//! Whether a method minimises the objective, for which it needs phi.
inline bool minimises(Method method) {
  return method != Method::kHarmonic && method != Method::kMeanValue;
}

//! Warm start from the state on another mesh, and the state to warm-start yet another one from;
//! either may be null. For methods that inherits() holds for.
template <int Dim>
struct WarmStart {
  const Transfer<Dim>* from = nullptr;    //!< where to start
  MeshState<Dim>* final_state = nullptr;  //!< where to leave the last state
  //! Called by methods that need neither any longer once they have started; may be empty.
  std::function<void()> started{};
  //! Instead of `from`, for Method::kValue on supports; may be null, and is then computed.
  const supports::ColdStart<Dim>* cold = nullptr;
  //! Whether the last state is a finer mesh's start, for which a rough one does.
  bool for_finer_mesh = false;
};

//! Method::kGradient and kPaper.
//! \param options  resolved, with the penalty on the problem's scale
//! \param report  iterations, status, residuals, penalty and seconds are filled in
//! \param storage  memory of the state, may be null
template <int Dim>
MethodResult solve_by_gradients(const LbcProblem<Dim>& problem, const SolverOptions& options,
                                SolveReport& report, StateStorage* storage,
                                WarmStart<Dim> warm_start);

//! Method::kValue. Parameters as above.
template <int Dim>
MethodResult solve_by_value(const LbcProblem<Dim>& problem, const SolverOptions& options,
                            SolveReport& report, StateStorage* storage, WarmStart<Dim> warm_start);

//! Method::kLbc2014. Parameters as above.
template <int Dim>
MethodResult solve_lbc2014(const LbcProblem<Dim>& problem, const SolverOptions& options,
                           SolveReport& report, StateStorage* storage, WarmStart<Dim> warm_start);

//! Any method, up to weights that may be negative. Parameters as above, but the penalty is in the
//! user's unit and the report is made anew.
template <int Dim>
MethodResult run_method(const LbcProblem<Dim>& problem, SolverOptions options, SolveReport& report,
                        StateStorage* storage, WarmStart<Dim> warm_start);

//! Everything after the iteration: non-negative rows, certificate, measures.
//! \tparam Result  Solution or SparseSolution
template <class Result, int Dim>
Result finish(const LbcProblem<Dim>& problem, const SolverOptions& options, MethodRun&& run);

//! p / A from p, in the form of MeshState.
template <class Scalar, int Dim>
FluxDensities<Dim> flux_densities(const LbcProblem<Dim>& problem,
                                  const CellFieldView<Scalar, Dim>& flux) {
  return {flux.n, problem.mesh.num_cells(),
          [&](Index s) -> Eigen::Matrix<double, Eigen::Dynamic, Dim> {
            return flux.cell(s).transpose() / signed_measure(problem.mesh, s);
          }};
}

//! Options by which whoever is told of the progress can ask for the objective.
//! \param weights  gives the present ones, n x V
template <int Dim>
SolverOptions with_objective(const LbcProblem<Dim>& problem, SolverOptions options,
                             std::function<WeightMatrix()> weights);

//! Penalties and relaxations without measure take the numbers out of their range, which must never
//! pass for a result. \throws SolverError unless `finite`
void require_finite(bool finite, const SolveReport& report);

//! The callback of a stage, for its loops.
inline TellPart told_of(const SolverOptions& options, Stage stage) {
  if (!options.stage_progress) return {};
  return [stage, tell = options.stage_progress](double done) { tell(stage, done); };
}

//! Ends the run or tells the caller, after an evaluation of the residuals that `report` holds.
//! Sets status and criterion. \return whether to stop
bool finished(int iteration, const SolverOptions& options, GapCriterion& gap, SolveReport& report);

}  // namespace flbc

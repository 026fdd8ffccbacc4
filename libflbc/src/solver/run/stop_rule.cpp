// SPDX-License-Identifier: BSD-3-Clause
#include "solver/run/stop_rule.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "mesh/cell_geometry.h"
#include "solver/plan/constants.h"

namespace flbc {
namespace {

template <int Dim>
WeightHistory::ReadRow rows_of(const Iteration<Dim>& iteration) {
  return [&](Index vertex, double* weights) { iteration.read_weights(vertex, weights); };
}

WeightHistory::ReadRow rows_of(const WeightMatrix& weights) {
  return [&](Index vertex, double* row) {
    std::copy_n(weights.col(vertex).data(), weights.rows(), row);
  };
}

}  // namespace

template <int Dim>
EstimatedError<Dim>::EstimatedError(const LbcProblem<Dim>& problem, const SolverOptions& options,
                                    Origin origin, bool rough)
    : options_(options),
      num_weights_(std::max(1.0, static_cast<double>(problem.boundary.interior_vertices().size())) *
                   problem.num_control_points()),
      residual_scale_(1 / (problem.num_control_points() * cell_measures(problem.mesh).sum())),
      estimate_(origin, *options.tolerance, !rough && problem.smoothness == 0),
      history_(problem.boundary.interior_vertices(), problem.num_control_points(),
               options.precision == Precision::kDouble) {
}

template <int Dim>
void EstimatedError<Dim>::begin(const Iteration<Dim>& iteration) {
  if (std::exchange(begun_, true)) return;
  history_(0, rows_of(iteration));
}

template <int Dim>
bool EstimatedError<Dim>::judge(const Step& step, const Iteration<Dim>& iteration,
                                SolveReport& report) {
  const auto movement = history_(report.iterations, rows_of(iteration));
  report.primal_residual = estimate_(report.iterations, step.change / num_weights_, movement,
                                     step.violation * residual_scale_) /
                           *options_.tolerance;
  return this->looks(options_, report, plan::kFewestIterations);
}

template <int Dim>
RecoveredError<Dim>::RecoveredError(const LbcProblem<Dim>& problem, const SolverOptions& options)
    : options_(options),
      interval_((plan::kRecoveryInterval + options.check_interval - 1) / options.check_interval *
                options.check_interval),
      residual_scale_(1 / (static_cast<double>(problem.num_control_points()) * (Dim + 2) *
                           problem.mesh.num_cells())),
      estimate_(Origin::kCold, *options.tolerance),
      history_(problem.boundary.interior_vertices(), problem.num_control_points(),
               options.precision == Precision::kDouble, interval_) {
}

template <int Dim>
void RecoveredError<Dim>::begin(const Iteration<Dim>& iteration) {
  history_(0, rows_of(iteration.weights().dense));
}

template <int Dim>
bool RecoveredError<Dim>::judge(const Step& step, const Iteration<Dim>& iteration,
                                SolveReport& report) {
  if (!std::isfinite(step.change) || !std::isfinite(step.violation)) {
    report.primal_residual = step.change + step.violation;
    return true;
  }
  if (report.iterations < interval_) report.primal_residual = 1 / *options_.tolerance;
  if (report.iterations % interval_ != 0) return true;
  const auto movement = history_(report.iterations, rows_of(iteration.weights().dense));
  // The residual is used separately, because single iterations are not measured.
  constexpr double kNone = 0;
  const double shown = movement ? estimate_(report.iterations, kNone, movement, kNone)
                                : plan::kUnknownError * *options_.tolerance;
  const double residual = residual_scale_ * step.violation;
  errors_.push_back(std::max(shown, plan::kErrorOfResidual * residual));
  // Differences oscillate as the state circles its limit, and the first ones after resuming are
  // small, so the maximum of several is used.
  if (errors_.size() > plan::kRecoveriesJudged) errors_.erase(errors_.begin());
  const double largest = *std::max_element(errors_.begin(), errors_.end()) / *options_.tolerance;
  report.primal_residual =
      errors_.size() < plan::kRecoveriesJudged ? std::max(largest, plan::kUnknownError) : largest;
  return true;
}

template <int Dim>
bool Residuals<Dim>::judge(const Step& step, const Iteration<Dim>&, SolveReport& report) {
  constexpr double kDualToPrimal = 10;  // section 5 of the paper: N 1e-7 and N 1e-6
  report.primal_residual = units_.primal * step.primal / *options_.tolerance;
  report.dual_residual = units_.dual * step.dual / (kDualToPrimal * *options_.tolerance);
  return true;
}

template class EstimatedError<2>;
template class EstimatedError<3>;
template class RecoveredError<2>;
template class RecoveredError<3>;
template class Residuals<2>;
template class Residuals<3>;

}  // namespace flbc

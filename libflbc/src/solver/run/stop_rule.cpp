// SPDX-License-Identifier: BSD-3-Clause
#include "solver/run/stop_rule.h"

#include <algorithm>
#include <cmath>

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
EstimatedError<Dim>::EstimatedError(const LbcProblem<Dim>& problem, const Iteration<Dim>& iteration,
                                    bool in_double, Origin origin, bool looks)
    : num_weights_(std::max(1.0, static_cast<double>(problem.boundary.interior_vertices().size())) *
                   problem.num_control_points()),
      residual_scale_(1 / (problem.num_control_points() * cell_measures(problem.mesh).sum())),
      estimate_(origin, looks),
      history_(problem.boundary.interior_vertices(), problem.num_control_points(), in_double) {
  history_(0, rows_of(iteration));
}

template <int Dim>
Ratios EstimatedError<Dim>::judge(const Step& step, const Iteration<Dim>& iteration, int made,
                                  double tolerance) {
  const auto movement = history_(made, rows_of(iteration));
  const double error = estimate_(made, tolerance, step.change / num_weights_, movement,
                                 step.violation * residual_scale_);
  return {error / tolerance};
}

template <int Dim>
RecoveredError<Dim>::RecoveredError(const LbcProblem<Dim>& problem, const Iteration<Dim>& iteration,
                                    bool in_double)
    : residual_scale_(1 / (static_cast<double>(problem.num_control_points()) * (Dim + 2) *
                           problem.mesh.num_cells())),
      estimate_(Origin::kCold),
      history_(problem.boundary.interior_vertices(), problem.num_control_points(), in_double,
               plan::kRecoveryInterval) {
  history_(0, rows_of(iteration.weights().dense));
}

template <int Dim>
Ratios RecoveredError<Dim>::judge(const Step& step, const Iteration<Dim>& iteration, int made,
                                  double tolerance) {
  if (!std::isfinite(step.change) || !std::isfinite(step.violation)) {
    return {step.change + step.violation};
  }
  if (made % plan::kRecoveryInterval == 0) {
    const auto movement = history_(made, rows_of(iteration.weights().dense));
    // The residual is used separately, because single iterations are not measured.
    constexpr double kNone = 0;
    const double shown = movement ? estimate_(made, tolerance, kNone, movement, kNone)
                                  : plan::kUnknownError * tolerance;
    const double residual = residual_scale_ * step.violation;
    errors_.push_back(std::max(shown, plan::kErrorOfResidual * residual));
    // Differences oscillate as the state circles its limit, so the maximum of several is used.
    if (errors_.size() > plan::kRecoveriesJudged) errors_.erase(errors_.begin());
  }
  if (errors_.empty()) return {1 / tolerance};
  const double largest = *std::max_element(errors_.begin(), errors_.end()) / tolerance;
  const bool known = errors_.size() == plan::kRecoveriesJudged;
  return {known ? largest : std::max(largest, plan::kUnknownError)};
}

template class EstimatedError<2>;
template class EstimatedError<3>;
template class RecoveredError<2>;
template class RecoveredError<3>;

}  // namespace flbc

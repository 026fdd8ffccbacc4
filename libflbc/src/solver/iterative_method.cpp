// SPDX-License-Identifier: BSD-3-Clause
#include "solver/iterative_method.h"

#include <cmath>
#include <limits>
#include <string>
#include <type_traits>
#include <utility>

#include "base/stage_progress.h"
#include "base/stopwatch.h"
#include "flbc/bounding_box.h"
#include "flbc/certificate.h"
#include "flbc/errors.h"
#include "flbc/harmonic.h"
#include "flbc/mean_value.h"
#include "flbc/non_negative.h"
#include "flbc/quality.h"
#include "solver/penalty_unit.h"

namespace flbc {
namespace {

// In the units of the mesh as it was given.
template <int Dim>
double unscaled(const LbcProblem<Dim>& problem, double objective) {
  return objective / std::pow(problem.scale, Dim - 1);
}

// Weights as the result wants them.
template <class Result>
auto take_weights(MethodResult& result) {
  if constexpr (std::is_same_v<Result, Solution>) {
    return result.is_sparse() ? std::exchange(result.sparse, {}).dense()
                              : std::move(result.weights);
  } else {
    if (!result.is_sparse()) result.sparse = SparseWeights(std::exchange(result.weights, {}));
    return std::move(result.sparse);
  }
}

template <int Dim>
void make_non_negative(const LbcProblem<Dim>& problem, WeightMatrix& weights) {
  project_non_negative(problem.cage.points, problem.mesh.points, weights,
                       problem.boundary.interior_vertices());
}

template <int Dim>
void make_non_negative(const LbcProblem<Dim>& problem, SparseWeights& weights) {
  weights = project_non_negative(problem.cage.points, problem.mesh.points, weights,
                                 problem.boundary.interior_vertices());
}

const WeightMatrix& dense(const WeightMatrix& weights) {
  return weights;
}
WeightMatrix dense(const SparseWeights& weights) {
  return weights.dense();
}

template <int Dim, class Weights>
Certificate certify(const LbcProblem<Dim>& problem, const MethodResult& result,
                    const Weights& weights) {
  auto certificate = result.certify(dense(weights));
  certificate.objective = unscaled(problem, certificate.objective);
  // Dividing by the power of the scale takes a few roundings, which must not make the bound larger.
  constexpr double kRoundings = 4 * std::numeric_limits<double>::epsilon();
  certificate.lower_bound = unscaled(problem, certificate.lower_bound) * (1 - kRoundings);
  return certificate;
}

// The penalty on the problem's scale; 0 where it is chosen from the mesh.
double scaled_penalty(const SolverOptions& options, int dim, double unit) {
  if (options.penalty > 0) return unit * options.penalty;
  if (options.method == Method::kPaper) return dim == 2 ? 100 : 10000;  // its section 5
  return 0;
}

}  // namespace

template <int Dim>
SolverOptions with_objective(const LbcProblem<Dim>& problem, SolverOptions options,
                             std::function<WeightMatrix()> weights) {
  if (!options.progress) return options;
  options.progress = [&problem, weights = std::move(weights),
                      tell = std::move(options.progress)](Progress progress) {
    progress.objective = [&] {
      return unscaled(problem, objective(problem.mesh, problem.phi, weights()));
    };
    return tell(progress);
  };
  return options;
}

void require_finite(bool finite, const SolveReport& report) {
  if (finite) return;
  throw SolverError("the computation broke down within " + std::to_string(report.iterations) +
                    " iterations: its numbers are not finite; try the default penalty and "
                    "relaxation, or double precision");
}

bool finished(int iteration, const SolverOptions& options, GapCriterion& gap, SolveReport& report) {
  require_finite(std::isfinite(report.primal_residual) && std::isfinite(report.dual_residual),
                 report);
  const bool last = iteration >= options.max_iterations;
  report.status = SolveStatus::kConverged;
  report.criterion = Criterion::kTolerance;
  if (report.primal_residual <= 1 && report.dual_residual <= 1) return true;
  report.criterion = Criterion::kGap;
  if (gap.is_met(iteration, last)) return true;
  report.criterion = Criterion::kNone;
  report.status = SolveStatus::kIterationLimit;
  if (last) return true;
  report.status = SolveStatus::kStopped;
  return options.progress &&
         !options.progress({iteration, report.primal_residual, report.dual_residual, 0, {}});
}

template <int Dim>
MethodResult run_method(const LbcProblem<Dim>& problem, SolverOptions options, SolveReport& report,
                        StateStorage* storage, WarmStart<Dim> warm_start) {
  Stopwatch watch;
  report = {};
  report.method = options.method;
  report.control_points = problem.num_control_points();
  report.vertices = problem.mesh.num_vertices();
  report.cells = problem.mesh.num_cells();
  const double unit = penalty_unit(options.method, Dim, bounding_box_diagonal(problem.cage.points));
  options.penalty = scaled_penalty(options, Dim, unit);
  require_finite(std::isfinite(options.penalty), report);
  MethodResult result;
  switch (options.method) {
    case Method::kHarmonic:
      result.weights = harmonic_coordinates(problem);
      report.seconds.solve = watch.lap();
      break;
    case Method::kMeanValue:
      result.weights = mean_value_coordinates(problem.cage, problem.mesh.points);
      report.seconds.solve = watch.lap();
      break;
    case Method::kValue:
      result = solve_by_value(problem, options, report, storage, warm_start);
      break;
    case Method::kLbc2014:
      result = solve_lbc2014(problem, options, report, storage, warm_start);
      break;
    default:
      result = solve_by_gradients(problem, options, report, storage, warm_start);
  }
  require_finite(result.is_sparse() || result.weights.allFinite(), report);
  report.published_penalty = report.penalty;
  report.penalty /= unit;
  return result;
}

template <class Result, int Dim>
Result finish(const LbcProblem<Dim>& problem, const SolverOptions& options, MethodRun&& run) {
  Stopwatch watch;
  auto& [result, report] = run;
  Result solution{take_weights<Result>(result), {}};
  if (options.non_negative != NonNegative::kOff) {
    const StageScope scope(told_of(options, Stage::kNonNegative));
    make_non_negative(problem, solution.weights);
  }
  report.seconds.recover += watch.lap();
  if (options.certify || report.criterion == Criterion::kGap) {
    const StageScope scope(told_of(options, Stage::kCertificate));
    report.certificate = certify(problem, result, solution.weights);
  }
  report.seconds.certify = watch.lap();
  report.objective = problem.phi.size() > 0
                         ? unscaled(problem, objective(problem.mesh, problem.phi, solution.weights))
                         : std::numeric_limits<double>::quiet_NaN();
  report.quality = measure_quality(problem.cage.points, problem.mesh.points, solution.weights);
  solution.report = std::move(report);
  return solution;
}

#define FLBC_INSTANTIATE(Dim)                                                                  \
  template SolverOptions with_objective(const LbcProblem<Dim>&, SolverOptions,                 \
                                        std::function<WeightMatrix()>);                        \
  template MethodResult run_method(const LbcProblem<Dim>&, SolverOptions, SolveReport&,        \
                                   StateStorage*, WarmStart<Dim>);                             \
  template Solution finish<Solution>(const LbcProblem<Dim>&, const SolverOptions&,             \
                                     MethodRun&&);                                             \
  template SparseSolution finish<SparseSolution>(const LbcProblem<Dim>&, const SolverOptions&, \
                                                 MethodRun&&);
FLBC_INSTANTIATE(2)
FLBC_INSTANTIATE(3)
#undef FLBC_INSTANTIATE

}  // namespace flbc

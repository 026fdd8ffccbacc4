// SPDX-License-Identifier: BSD-3-Clause
#include "solver/api/finish.h"

#include <limits>
#include <utility>

#include "base/stage_progress.h"
#include "base/stopwatch.h"
#include "flbc/non_negative.h"
#include "flbc/quality.h"
#include "solver/run/run.h"

namespace flbc {
namespace {

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

template <int Dim, class AnyWeights>
Certificate certify(const LbcProblem<Dim>& problem, const MethodRun<Dim>& run,
                    const AnyWeights& weights) {
  auto certificate = run.certify(dense(weights));
  certificate.objective = unscaled(problem, certificate.objective);
  // Dividing by the power of the scale takes a few roundings, which must not make the bound larger.
  constexpr double kRoundings = 4 * std::numeric_limits<double>::epsilon();
  certificate.lower_bound = unscaled(problem, certificate.lower_bound) * (1 - kRoundings);
  return certificate;
}

template <int Dim, class AnyWeights>
void finish_as(const LbcProblem<Dim>& problem, const MethodRun<Dim>& run, AnyWeights& weights,
               const SolverOptions& options, const Reporter& reporter, SolveReport& report) {
  Stopwatch watch;
  if (options.non_negative != NonNegative::kOff) {
    const StageScope scope(reporter.stage(Stage::kNonNegative));
    make_non_negative(problem, weights);
  }
  report.seconds.recover += watch.lap();
  if (options.certify || report.criterion == Criterion::kGap) {
    const StageScope scope(reporter.stage(Stage::kCertificate));
    report.certificate = certify(problem, run, weights);
  }
  report.seconds.certify = watch.lap();
  report.objective = problem.phi.size() > 0
                         ? unscaled(problem, objective(problem.mesh, problem.phi, weights))
                         : std::numeric_limits<double>::quiet_NaN();
  report.quality = measure_quality(problem.cage.points, problem.mesh.points, weights);
}

}  // namespace

template <int Dim>
Solution finish(const LbcProblem<Dim>& problem, const MethodRun<Dim>& run, Weights weights,
                const SolverOptions& options, const Reporter& reporter, SolveReport report) {
  Solution solution{{}, {}, std::move(report)};
  if (options.sparse) {
    solution.sparse_weights =
        weights.is_sparse() ? std::move(weights.sparse) : SparseWeights(std::move(weights.dense));
    finish_as(problem, run, solution.sparse_weights, options, reporter, solution.report);
  } else {
    solution.weights = std::move(weights).to_dense();
    weights = {};
    finish_as(problem, run, solution.weights, options, reporter, solution.report);
  }
  return solution;
}

template Solution finish(const LbcProblem<2>&, const MethodRun<2>&, Weights, const SolverOptions&,
                         const Reporter&, SolveReport);
template Solution finish(const LbcProblem<3>&, const MethodRun<3>&, Weights, const SolverOptions&,
                         const Reporter&, SolveReport);

}  // namespace flbc

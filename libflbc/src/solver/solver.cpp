// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/solver.h"

#include <cmath>

#include "base/parallel.h"
#include "base/stopwatch.h"
#include "flbc/certificate.h"
#include "flbc/harmonic.h"
#include "flbc/mean_value.h"
#include "flbc/non_negative.h"
#include "flbc/quality.h"
#include "flbc/recovery.h"
#include "solver/iterative_method.h"

namespace flbc {
namespace {

// In the units of the mesh as it was given.
template <int Dim>
double unscaled(const LbcProblem<Dim>& problem, double objective) {
  return objective / std::pow(problem.scale, Dim - 1);
}

template <int Dim>
Certificate certify(const LbcProblem<Dim>& problem, const MethodResult& result) {
  auto certificate = result.certify(result.weights);
  certificate.objective = unscaled(problem, certificate.objective);
  certificate.lower_bound = unscaled(problem, certificate.lower_bound);
  return certificate;
}

}  // namespace

template <int Dim>
MethodResult run_method(const LbcProblem<Dim>& problem, const SolverOptions& options,
                        SolveReport& report, StateStorage* storage, WarmStart<Dim> warm_start) {
  Stopwatch watch;
  report = {};
  report.method = options.method;
  report.control_points = problem.num_control_points();
  report.vertices = problem.mesh.num_vertices();
  report.cells = problem.mesh.num_cells();
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
    case Method::kLbc2014:
      result = solve_by_splitting(problem, options, report, storage, warm_start);
      break;
    default:
      result = solve_by_gradients(problem, options, report, storage, warm_start);
  }
  require_finite(result.weights.allFinite(), options, report);
  return result;
}

template <int Dim>
Solution finish(const LbcProblem<Dim>& problem, const SolverOptions& options, MethodResult result,
                SolveReport report) {
  Stopwatch watch;
  if (options.non_negative != NonNegative::kOff) {
    project_non_negative(problem.cage.points, problem.mesh.points, result.weights,
                         problem.boundary.interior_vertices());
  }
  report.seconds.recover += watch.lap();
  if (options.certify) report.certificate = certify(problem, result);
  report.seconds.certify = watch.lap();
  report.objective = unscaled(problem, objective(problem.mesh, problem.phi, result.weights));
  report.quality = measure_quality(problem.cage.points, problem.mesh.points, result.weights);
  return {std::move(result.weights), std::move(report)};
}

template <int Dim>
Solution solve(const LbcProblem<Dim>& problem, const SolverOptions& user_options,
               StateStorage* storage) {
  validate(user_options);
  const auto options = resolve(user_options, Dim);
  const ThreadScope threads(options.threads);
  SolveReport report;
  auto result = run_method(problem, options, report, storage, WarmStart<Dim>{});
  return finish(problem, options, std::move(result), std::move(report));
}

template <int Dim>
Solution solve(const Cage<Dim>& cage, const DomainMesh<Dim>& mesh, const SolverOptions& options) {
  validate(options);
  const ThreadScope threads(options.threads);
  Stopwatch watch;
  const auto problem = make_problem(cage, mesh, options.phi);
  const double setup = watch.lap();
  auto solution = solve(problem, options);
  solution.report.seconds.setup = setup;
  return solution;
}

template MethodResult run_method(const LbcProblem<2>&, const SolverOptions&, SolveReport&,
                                 StateStorage*, WarmStart<2>);
template MethodResult run_method(const LbcProblem<3>&, const SolverOptions&, SolveReport&,
                                 StateStorage*, WarmStart<3>);
template Solution finish(const LbcProblem<2>&, const SolverOptions&, MethodResult, SolveReport);
template Solution finish(const LbcProblem<3>&, const SolverOptions&, MethodResult, SolveReport);
template Solution solve(const LbcProblem<2>&, const SolverOptions&, StateStorage*);
template Solution solve(const LbcProblem<3>&, const SolverOptions&, StateStorage*);
template Solution solve(const Cage<2>&, const DomainMesh<2>&, const SolverOptions&);
template Solution solve(const Cage<3>&, const DomainMesh<3>&, const SolverOptions&);

}  // namespace flbc

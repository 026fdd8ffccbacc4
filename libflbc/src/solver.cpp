// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/solver.h"

#include <chrono>
#include <cmath>

#include "flbc/coordinates.h"
#include "flbc/errors.h"
#include "flbc/recovery.h"
#include "format.h"
#include "gradient/gradient_admm.h"
#include "parallel.h"

namespace flbc {
namespace {

class Stopwatch {
 public:
  //! Seconds since construction or the last call.
  double lap() {
    const auto now = Clock::now();
    const double seconds = std::chrono::duration<double>(now - start_).count();
    start_ = now;
    return seconds;
  }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point start_ = Clock::now();
};

// Penalties and relaxations without measure take the numbers out of their range, which must never
// pass for a result.
void require_finite(bool finite, const SolverOptions& options, const SolveReport& report) {
  if (finite) return;
  throw SolverError("the computation broke down within " + std::to_string(report.iterations) +
                    " iterations: its numbers are not finite; with penalty " +
                    format_number(options.penalty) + " and relaxation " +
                    format_number(options.relaxation) + ", try the defaults or double precision");
}

// Iterates until both residuals are below their thresholds (section 4.2.1 of the paper), the limit
// is reached or the caller stops the run.
template <class Scalar, int Dim>
void run(gradient::GradientAdmm<Scalar, Dim>& admm, const SolverOptions& options,
         SolveReport& report) {
  // The paper's dual threshold is 10 times its primal one; one tolerance keeps their ratio.
  const double components = admm.num_residual_components();
  const double primal_threshold =
      options.tolerance * (options.method == Method::kPaper ? components : std::sqrt(components));
  const double dual_threshold = 10 * primal_threshold;
  for (int iteration = 1;; ++iteration) {
    const auto change = admm.iterate();
    report.iterations = iteration;
    const bool last = iteration >= options.max_iterations;
    if (iteration % options.check_interval != 0 && !last) continue;

    const auto residuals = admm.residuals(change);
    report.primal_residual = residuals.primal / primal_threshold;
    report.dual_residual = residuals.dual / dual_threshold;
    require_finite(std::isfinite(residuals.primal) && std::isfinite(residuals.dual), options,
                   report);
    report.status = SolveStatus::kConverged;
    if (report.primal_residual <= 1 && report.dual_residual <= 1) return;
    report.status = SolveStatus::kIterationLimit;
    if (last) return;
    report.status = SolveStatus::kStopped;
    if (options.progress &&
        !options.progress({iteration, report.primal_residual, report.dual_residual})) {
      return;
    }
  }
}

template <class Scalar, int Dim>
WeightMatrix solve_gradients(const LbcProblem<Dim>& problem, const SolverOptions& options,
                             SolveReport& report) {
  Stopwatch watch;
  gradient::GradientAdmm<Scalar, Dim> admm(problem, options.penalty, options.relaxation,
                                           gradient::boundary_periods(problem));
  if (options.method == Method::kPaper) {
    admm.start_from_least_norm();
  } else {
    admm.start_from_weights(harmonic_coordinates(problem));
  }
  run(admm, options, report);
  report.numbers_per_cell = admm.numbers_per_cell();
  report.seconds.solve = watch.lap();
  auto weights = options.recovery == Recovery::kBreadthFirst
                     ? integrate_breadth_first(problem, admm.gradients())
                     : integrate_least_squares(problem, admm.gradients());
  report.seconds.recover = watch.lap();
  return weights;
}

}  // namespace

template <int Dim>
Solution solve(const LbcProblem<Dim>& problem, const SolverOptions& user_options) {
  validate(user_options);
  const auto options = resolve(user_options, Dim);
  const ThreadScope threads(options.threads);

  Solution solution;
  auto& report = solution.report;
  report.method = options.method;
  report.control_points = problem.num_control_points();
  report.vertices = problem.mesh.num_vertices();
  report.cells = problem.mesh.num_cells();
  if (options.method == Method::kHarmonic) {
    Stopwatch watch;
    solution.weights = harmonic_coordinates(problem);
    report.seconds.solve = watch.lap();
  } else if (options.precision == Precision::kSingle) {
    solution.weights = solve_gradients<float>(problem, options, report);
  } else {
    solution.weights = solve_gradients<double>(problem, options, report);
  }
  require_finite(solution.weights.allFinite(), options, report);
  report.objective =
      objective(problem.mesh, problem.phi, solution.weights) / std::pow(problem.scale, Dim - 1);
  report.quality = measure_quality(problem.cage.points, problem.mesh.points, solution.weights);
  return solution;
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

template Solution solve(const LbcProblem<2>&, const SolverOptions&);
template Solution solve(const LbcProblem<3>&, const SolverOptions&);
template Solution solve(const Cage<2>&, const DomainMesh<2>&, const SolverOptions&);
template Solution solve(const Cage<3>&, const DomainMesh<3>&, const SolverOptions&);

}  // namespace flbc

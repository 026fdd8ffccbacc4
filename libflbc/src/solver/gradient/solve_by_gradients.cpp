// SPDX-License-Identifier: BSD-3-Clause
// The paper's solver from start to weights.
#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "base/stopwatch.h"
#include "flbc/bounding_box.h"
#include "flbc/certificate.h"
#include "flbc/quality.h"
#include "mesh/cell_geometry.h"
#include "solver/gradient/gradient_admm.h"
#include "solver/gradient/weight_recovery.h"
#include "solver/iterative_method.h"
#include "solver/run_state.h"
#include "solver/splitting/error_estimate.h"
#include "solver/splitting/splitting_data.h"
#include "solver/state_storage.h"

namespace flbc {
namespace {

// A factor of a large tetrahedral mesh takes longer than the iteration.
template <int Dim>
LinearSolver linear_solver_for(const LbcProblem<Dim>& problem, const SolverOptions& options) {
  constexpr Index kLargest = Dim == 2 ? 2000000 : 20000;  // vertices
  if (options.linear_solver != LinearSolver::kAuto) return options.linear_solver;
  return problem.mesh.num_vertices() > kLargest ? LinearSolver::kMultigrid : LinearSolver::kDirect;
}

// Scaled duals should be as large as gradients, 1 / size. The Z-step's are phi A / mu; a facet's
// multiplier is a potential, of the order of the size, times what the facet measures, and takes the
// longest to build up. Hence what facets measure times the squared size of the cage; the factors
// served best on all models (docs/lab_book.md).
template <int Dim>
double penalty_for(const LbcProblem<Dim>& problem) {
  constexpr double kFactor = Dim == 2 ? 1.0 / 3500 : 1.0 / 6000;
  const Eigen::VectorXd measures = cell_measures(problem.mesh);
  const double length = std::pow(measures.squaredNorm() / measures.sum(), 1.0 / Dim);
  const double size = bounding_box_diagonal(problem.cage.points);
  return kFactor * size * size * std::pow(length, Dim - 1);
}

// Method::kPaper: iterates until both residuals are below their thresholds (section 4.2.1), the
// limit is reached or the caller stops the run.
template <class Scalar, int Dim>
void iterate_to_residuals(gradient::GradientAdmm<Scalar, Dim>& admm, const SolverOptions& options,
                          GapCriterion& gap, SolveReport& report) {
  constexpr double kDualToPrimal = 10;
  const double threshold = options.tolerance * admm.num_residual_components();
  for (bool ends = false; !ends;) {
    const int count = std::min(options.check_interval, options.max_iterations - report.iterations);
    const auto residuals = admm.residuals(admm.iterate(count));
    report.iterations += count;
    report.primal_residual = residuals.primal / threshold;
    report.dual_residual = residuals.dual / (kDualToPrimal * threshold);
    ends = finished(report.iterations, options, gap, report);
  }
}

// Method::kGradient: ends by the estimated error of its weights, which are recovered now and then.
template <class Scalar, int Dim>
class RunToError {
 public:
  //! \param recover  the present weights \param start  those of the start, if known
  RunToError(const LbcProblem<Dim>& problem, const SolverOptions& options,
             std::function<WeightMatrix()> recover, WeightMatrix start, bool warm)
      : problem_(problem),
        options_(options),
        recover_(std::move(recover)),
        weights_(std::move(start)),
        interval_((kFewest + options.check_interval - 1) / options.check_interval *
                  options.check_interval),
        residual_scale_(square(bounding_box_diagonal(problem.cage.points)) /
                        (static_cast<double>(problem.num_control_points()) * (Dim + 2) *
                         problem.mesh.num_cells())),
        estimate_(warm ? splitting::Start::kNearby : splitting::Start::kCold, Dim,
                  options.tolerance, interval_) {}

  //! \param options  of the run, with who is told of it
  void iterate(gradient::GradientAdmm<Scalar, Dim>& admm, const SolverOptions& options,
               GapCriterion& gap, SolveReport& report) {
    if (report.iterations == 0) {
      report.primal_residual = 1 / options_.tolerance;  // weights are between 0 and 1
    }
    for (bool ends = false; !ends;) {
      const int count =
          std::min(options_.check_interval, options_.max_iterations - report.iterations);
      const auto change = admm.iterate(count);
      report.iterations += count;
      require_finite(std::isfinite(change.gradient) && std::isfinite(change.dual), report);
      if (report.iterations % interval_ == 0) look(residual_scale_ * change.dual, report);
      ends = finished(report.iterations, options, gap, report);
    }
  }

  // Writes or reads what the iteration itself does not know.
  template <class Archive>
  void visit(Archive& archive) {
    archive(weights_, looked_at_, errors_);
    estimate_.visit(archive);
  }

  // Whether what was read can be of a run on this problem.
  bool is_undamaged() const {
    if (weights_.size() == 0) return looked_at_ == -1;
    return weights_.rows() == problem_.num_control_points() &&
           weights_.cols() == problem_.mesh.num_vertices();
  }

  // The last weights, if they are those of this iteration.
  WeightMatrix take_weights(int iteration) {
    return iteration == looked_at_ ? std::move(weights_) : recover_();
  }

 private:
  static double square(double x) { return x * x; }

  // Iterations between two recoveries, each of which takes as long as one or two of these.
  static constexpr int kFewest = 32;

  //! \param residual  squared violation of the copies, mean, times the squared size of the cage
  void look(double residual, SolveReport& report) {
    auto weights = recover_();
    if (weights_.size() > 0) {
      const double difference = squared_error(problem_, weights, weights_);
      // Single iterations are not measured, and the residual counts by itself: on all meshes tried
      // the error was at least so many times as large.
      constexpr double kNone = 0;
      constexpr double kOfResidual = 2;
      const double shown = estimate_(report.iterations, kNone, difference, kNone);
      errors_.push_back(std::max(shown, kOfResidual * residual));
      // Differences go up and down with the state that circles its limit, and after a warm start
      // the first ones are small: the largest of some looks counts.
      constexpr std::size_t kLooks = 3;
      constexpr double kUnknown = 2;  // tolerances
      if (errors_.size() > kLooks) errors_.erase(errors_.begin());
      const double largest = *std::max_element(errors_.begin(), errors_.end()) / options_.tolerance;
      report.primal_residual = errors_.size() < kLooks ? std::max(largest, kUnknown) : largest;
    }
    weights_ = std::move(weights);
    looked_at_ = report.iterations;
  }

  const LbcProblem<Dim>& problem_;
  const SolverOptions& options_;
  std::function<WeightMatrix()> recover_;
  WeightMatrix weights_;
  int looked_at_ = -1;
  const int interval_;
  const double residual_scale_;
  splitting::ErrorEstimate estimate_;
  std::vector<double> errors_;  // of the last looks
};

template <class Scalar, int Dim>
MeshState<Dim> keep_state(gradient::GradientAdmm<Scalar, Dim>& admm, const LbcProblem<Dim>& problem,
                          double penalty) {
  MeshState<Dim> state;
  state.penalty = penalty;
  state.flux_density = flux_densities(problem, admm.flux());
  state.potential =
      flux_potential<Dim>(problem, [&](Index facet) { return admm.facet_multiplier(facet); });
  state.periods = admm.period_factors();
  return state;
}

// \return the weights it starts from; none from a state that is there, or from least-norm gradients
template <class Scalar, int Dim>
WeightMatrix start(gradient::GradientAdmm<Scalar, Dim>& admm, const SolverOptions& options,
                   gradient::WeightRecovery<Dim>& recovery, const StateStorage* storage,
                   const Transfer<Dim>* from) {
  if (resumes(storage)) return {};
  if (from != nullptr && options.method == Method::kGradient) {
    auto weights = from->weights();
    admm.start_from_duals(
        weights, [from](Index s) { return from->flux_density(s); },
        [from](Index facet) { return from->facet_multiplier(facet); }, from->periods());
    return weights;
  }
  if (options.method == Method::kPaper || options.linear_solver == LinearSolver::kNone) {
    admm.start_from_least_norm();
    return {};
  }
  auto weights = recovery.harmonic();
  admm.start_from_weights(weights);
  return weights;
}

template <class Scalar, int Dim>
MethodResult solve(const LbcProblem<Dim>& problem, const SolverOptions& options,
                   SolveReport& report, StateStorage* storage, WarmStart<Dim> warm_start) {
  Stopwatch watch;
  const auto linear_solver = linear_solver_for(problem, options);
  gradient::WeightRecovery<Dim> recovery(problem, options.recovery, linear_solver);
  const double penalty = options.penalty > 0 ? options.penalty
                         : resumes(storage)  ? storage->penalty()
                                             : penalty_for(problem);
  const auto admm = std::make_shared<gradient::GradientAdmm<Scalar, Dim>>(
      problem, penalty, options.relaxation, gradient::boundary_periods(problem, linear_solver),
      storage);
  ByteReader read(options.resume_from);
  const bool goes_on = !read.is_at_end();
  auto first_weights =
      goes_on ? WeightMatrix() : start(*admm, options, recovery, storage, warm_start.from);
  if (warm_start.started) warm_start.started();
  const auto certify_weights = [admm, &problem](const WeightMatrix& weights) {
    return certify(problem, admm->flux(), weights);
  };
  const auto recover = [&] { return recovery(admm->gradients()); };
  GapCriterion gap(*options.gap, [&] { return certify_weights(recover()); });
  report.iterations = 0;
  RunToError<Scalar, Dim> run(problem, options, recover, std::move(first_weights),
                              warm_start.from != nullptr || resumes(storage));
  const auto visit = [&](auto& archive) {
    admm->visit(archive);
    archive(report.iterations, report.primal_residual);
    run.visit(archive);
    gap.visit(archive);
  };
  if (goes_on) {
    visit(read);
    require_undamaged(run.is_undamaged());
    require_whole_state(read, report, options);
  }
  const auto told = offering(options, visit);
  if (options.method == Method::kPaper) {
    iterate_to_residuals(*admm, told, gap, report);
  } else {
    run.iterate(*admm, told, gap, report);
  }
  report.state_scalars_per_cell = admm->state_scalars_per_cell();
  report.penalty = penalty;
  if (storage != nullptr) storage->keep_penalty(penalty);
  report.seconds.solve = watch.lap();
  MethodResult result{run.take_weights(report.iterations), certify_weights};
  report.seconds.recover = watch.lap();
  if (warm_start.final_state) {
    *warm_start.final_state = keep_state(*admm, problem, penalty);
    warm_start.final_state->weights = SparseWeights(result.weights);
  }
  return result;
}

}  // namespace

template <int Dim>
MethodResult solve_by_gradients(const LbcProblem<Dim>& problem, const SolverOptions& options,
                                SolveReport& report, StateStorage* storage,
                                WarmStart<Dim> warm_start) {
  return options.precision == Precision::kDouble
             ? solve<double>(problem, options, report, storage, warm_start)
             : solve<float>(problem, options, report, storage, warm_start);
}

template MethodResult solve_by_gradients(const LbcProblem<2>&, const SolverOptions&, SolveReport&,
                                         StateStorage*, WarmStart<2>);
template MethodResult solve_by_gradients(const LbcProblem<3>&, const SolverOptions&, SolveReport&,
                                         StateStorage*, WarmStart<3>);

}  // namespace flbc

// SPDX-License-Identifier: BSD-3-Clause
// Method::kLbc2014 from start to weights.
#include <algorithm>
#include <cmath>
#include <memory>

#include "base/stopwatch.h"
#include "flbc/bounding_box.h"
#include "flbc/certificate.h"
#include "flbc/harmonic.h"
#include "solver/iterative_method.h"
#include "solver/run_state.h"
#include "solver/splitting/weight_splitting.h"
#include "solver/state_storage.h"

namespace flbc {
namespace {

template <class Scalar, int Dim>
using Splitting = splitting::WeightSplitting<Scalar, Dim>;

// The augmented Lagrangian of (2), in which a cell weighs its squared measure: of the constraint
// A z = A grad w. With a penalty that is given, that is all there is to it, and W = w has the same
// weight as every other constraint. Otherwise penalty and weight of W = w are chosen such that on
// average over the domain they act as kValue's, whose metric is the measure.
template <int Dim>
class AugmentedLagrangian {
 public:
  AugmentedLagrangian(const LbcProblem<Dim>& problem, const SolverOptions& options)
      : chosen_(options.penalty == 0), penalty_(options.penalty) {
    constexpr double kOfSize = 1.0 / 30;  // the best one of those measured (docs/lab_book.md)
    const auto like_value =
        splitting::measure_metric(problem, options.non_negative == NonNegative::kConstraint);
    const Eigen::VectorXd& measures = like_value.cell;
    mean_measure_ = measures.squaredNorm() / measures.sum();
    metric_.cell = measures.cwiseAbs2();
    if (chosen_) penalty_ = kOfSize * bounding_box_diagonal(problem.cage.points) / mean_measure_;
    if (like_value.vertex.size() == 0) return;
    const double weight = chosen_ ? mean_measure_ * like_value.vertex.mean() : 1;
    metric_.vertex = Eigen::VectorXd::Constant(problem.mesh.num_vertices(), weight);
  }

  bool is_chosen() const { return chosen_; }
  const splitting::Metric& metric() const { return metric_; }
  double penalty() const { return penalty_; }

  // rho m is on average this multiple of the measure; what penalties of two meshes have in common.
  double per_measure(double penalty) const { return penalty * mean_measure_; }
  double from_per_measure(double multiple) const { return multiple / mean_measure_; }

 private:
  bool chosen_;
  double penalty_;
  double mean_measure_ = 0;
  splitting::Metric metric_;
};

template <class Scalar, int Dim>
void start(Splitting<Scalar, Dim>& splitting, const LbcProblem<Dim>& problem,
           const AugmentedLagrangian<Dim>& lagrangian, const StateStorage* storage,
           const Transfer<Dim>* from) {
  constexpr int kMostSolves = 8;
  if (resumes(storage)) {
    splitting.resume();
  } else if (from != nullptr) {
    const double per_measure = lagrangian.per_measure(splitting.penalty());
    splitting.start_from_duals(
        from->weights(), [from](Index s) { return from->flux_density(s); },
        from->vertex_dual(per_measure));
  } else if (lagrangian.is_chosen()) {
    splitting.start_from_harmonic(kMostSolves);
  } else {
    // Where W = w weighs much, the iteration's own factor takes hundreds of solves to get there.
    splitting.start_from_weights(harmonic_coordinates(problem));
  }
}

// Ends by the thresholds of section 5 of the paper: norms at most N 1e-7 and N 1e-6 by default.
template <class Scalar, int Dim>
void iterate(Splitting<Scalar, Dim>& splitting, const SolverOptions& options, GapCriterion& gap,
             SolveReport& report) {
  constexpr double kDualToPrimal = 10;
  const double threshold = options.tolerance * splitting.num_residual_components();
  for (bool ends = false; !ends;) {
    const int iteration = ++report.iterations;
    if (iteration % options.check_interval != 0 && iteration < options.max_iterations) {
      splitting.iterate();
      continue;
    }
    const auto residuals = splitting.iterate_with_residuals();
    report.primal_residual = residuals.primal / threshold;
    report.dual_residual = residuals.dual / (kDualToPrimal * threshold);
    ends = finished(iteration, options, gap, report);
  }
}

template <class Scalar, int Dim>
MeshState<Dim> state_of(Splitting<Scalar, Dim>& splitting, const LbcProblem<Dim>& problem,
                        double per_measure) {
  MeshState<Dim> state;
  state.penalty = per_measure;
  state.weights = SparseWeights(splitting.weights());
  state.vertex_dual = SparseWeights(splitting.vertex_dual());
  state.flux_density = flux_densities(problem, splitting.flux());
  return state;
}

template <class Scalar, int Dim>
MethodResult solve_in(const LbcProblem<Dim>& problem, const SolverOptions& options,
                      SolveReport& report, StateStorage* storage, WarmStart<Dim> warm_start) {
  Stopwatch watch;
  const AugmentedLagrangian<Dim> lagrangian(problem, options);
  double penalty = lagrangian.penalty();
  ByteReader read(options.resume_from);
  const bool goes_on = !read.is_at_end();
  if (goes_on) {
    read(penalty);
    require_undamaged(penalty > 0 && std::isfinite(penalty));
  } else if (resumes(storage)) {
    penalty = storage->penalty();
  } else if (warm_start.from && lagrangian.is_chosen()) {
    penalty = lagrangian.from_per_measure(warm_start.from->penalty());
  }
  const auto linear_solver = options.linear_solver == LinearSolver::kMultigrid
                                 ? LinearSolver::kMultigrid
                                 : LinearSolver::kDirect;
  const auto splitting = std::make_shared<Splitting<Scalar, Dim>>(
      problem, lagrangian.metric(), penalty, options.relaxation, linear_solver, storage);
  if (!goes_on) start(*splitting, problem, lagrangian, storage, warm_start.from);
  if (warm_start.started) warm_start.started();

  const auto certify_weights = [splitting, &problem](const WeightMatrix& weights) {
    return certify(problem, splitting->flux(), weights);
  };
  GapCriterion gap(*options.gap, [&] { return certify_weights(splitting->weights()); });
  report.iterations = 0;
  const auto visit = [&](auto& archive) {
    splitting->visit(archive);
    archive(report.iterations);
    gap.visit(archive);
  };
  if (goes_on) {
    visit(read);
    require_whole_state(read, report, options);
  }
  const auto told = offering(with_objective(problem, options, [&] { return splitting->weights(); }),
                             [&](ByteWriter& write) {
                               write(penalty);
                               visit(write);
                             });
  iterate(*splitting, told, gap, report);
  report.penalty = penalty;
  report.state_scalars_per_cell = splitting->state_scalars_per_cell();
  if (storage != nullptr) storage->keep_penalty(penalty);
  report.seconds.solve = watch.lap();
  if (warm_start.final_state) {
    *warm_start.final_state = state_of(*splitting, problem, lagrangian.per_measure(penalty));
  }
  return {splitting->weights(), certify_weights};
}

}  // namespace

template <int Dim>
MethodResult solve_lbc2014(const LbcProblem<Dim>& problem, const SolverOptions& options,
                           SolveReport& report, StateStorage* storage, WarmStart<Dim> warm_start) {
  return options.precision == Precision::kDouble
             ? solve_in<double>(problem, options, report, storage, warm_start)
             : solve_in<float>(problem, options, report, storage, warm_start);
}

template MethodResult solve_lbc2014(const LbcProblem<2>&, const SolverOptions&, SolveReport&,
                                    StateStorage*, WarmStart<2>);
template MethodResult solve_lbc2014(const LbcProblem<3>&, const SolverOptions&, SolveReport&,
                                    StateStorage*, WarmStart<3>);

}  // namespace flbc

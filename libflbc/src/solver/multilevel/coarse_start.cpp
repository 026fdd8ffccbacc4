// SPDX-License-Identifier: BSD-3-Clause
#include "solver/multilevel/coarse_start.h"

#include <algorithm>
#include <utility>

#include "base/parallel.h"
#include "base/stopwatch.h"
#include "solver/methods/active_set/active_lists.h"
#include "solver/plan/choices.h"
#include "solver/plan/constants.h"
#include "solver/start/prolongation.h"

namespace flbc {
namespace {

// SolveReport::mesh_error. \param coarse  weights on the coarse mesh
template <int Dim>
double mesh_error(const LbcProblem<Dim>& problem, const Weights& weights,
                  const SparseWeights& coarse, const std::vector<std::array<Index, 2>>& ends) {
  const auto& interior = problem.boundary.interior_vertices();
  const auto count = static_cast<Index>(interior.size());
  const double sum = parallel_sum(count, 0.0, [&](Index begin, Index end) {
    double part = 0;
    for (Index k = begin; k < end; ++k) {
      const Index v = interior[k];
      const auto [a, b] = ends[v];
      const Eigen::VectorXd here =
          weights.is_sparse() ? weights.sparse.at(v) : weights.dense.col(v);
      part += (here - (coarse.at(a) + coarse.at(b)) / 2).squaredNorm();
    }
    return part;
  });
  const double numbers = std::max(1.0, double(count) * problem.num_control_points());
  return sum / numbers / plan::coarse_to_mesh_error(Dim);
}

}  // namespace

template <int Dim>
CoarseStart<Dim>::CoarseStart(const LbcProblem<Dim>& problem, CoarseProblem<Dim> coarse,
                              const plan::Settings& given, const Reporter& reporter)
    : problem_(problem), coarse_(std::move(coarse.problem)), ends_(std::move(coarse.ends)) {
  Stopwatch watch;
  auto settings = given;
  settings.tolerance = plan::kCoarseTolerance;
  settings.certify = false;
  const ThreadScope threads(
      threads_for(given.threads, coarse_->num_control_points(), coarse_->mesh.num_vertices()));
  settings.gap = 0;
  settings.ends_by_gap = false;
  SolveReport report;
  MethodRun<Dim> run(*coarse_);
  run.solve(settings, reporter.with_more_to_come(1), report);
  // An active set on the finer mesh reads duals only near nonzero weights.
  const bool on_active_set = plan::active_set(plan::sizes_of(*coarse_), given);
  warm_start_ = run.warm_start(on_active_set ? active_set::threshold_for(*given.tolerance) : 0);
  level_ = {report.vertices, report.cells, report.iterations, watch.lap()};
  stopped_ = report.status == SolveStatus::kStopped;
}

template <int Dim>
RunStart<Dim> CoarseStart<Dim>::start(const Prolongation<Dim>* given) {
  prolongation_.emplace(*coarse_, warm_start_, problem_, ends_);
  const auto forget = [this] {
    weights_ = std::move(warm_start_.weights);
    warm_start_ = {};
    coarse_.reset();
  };
  if (given == nullptr) return {&*prolongation_, nullptr, forget};
  return {given, &*prolongation_, forget};
}

template <int Dim>
void CoarseStart<Dim>::describe(const Weights& weights, SolveReport& report) const {
  if (stopped_) report.status = SolveStatus::kStopped;
  report.seconds.solve += level_.solve_seconds;
  report.coarse_levels = {level_};
  report.mesh_error = mesh_error(problem_, weights, weights_, ends_);
}

template class CoarseStart<2>;
template class CoarseStart<3>;

}  // namespace flbc

// SPDX-License-Identifier: BSD-3-Clause
#include "solver/methods/active_set/active_set.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/parallel.h"
#include "mesh/cell_geometry.h"
#include "solver/plan/constants.h"

namespace flbc::active_set {
namespace {

// Squared norms whose ratio gives the penalty: of the duals, and of the change of the weights since
// the start.
template <int Dim>
Eigen::Vector2d moved_lengths2(const LbcProblem<Dim>& problem, const splitting::Metric& metric,
                               const VectorsAt<1>& before, const Start<Dim>& now) {
  const Eigen::Vector2d zero = Eigen::Vector2d::Zero();
  return parallel_sum(problem.mesh.num_cells(), zero, [&](Index begin, Index end) {
    Eigen::Vector2d sum = zero;
    for (Index s = begin; s < end; ++s) {
      const auto geometry = cell_geometry(problem.mesh, s);
      Vectors<Dim> motion = Vectors<Dim>::Zero(problem.num_control_points(), Dim);
      for (int k = 0; k <= Dim; ++k) {
        const Index v = problem.mesh.cells(k, s);
        if (!problem.boundary.is_interior(v)) continue;
        motion += (now.weights(v) - before(v)) * geometry.hat_gradients.col(k).transpose();
      }
      sum[0] +=
          geometry.measure * geometry.measure / metric.cell[s] * now.flux_density(s).squaredNorm();
      sum[1] += metric.cell[s] * motion.squaredNorm();
    }
    return sum;
  });
}

}  // namespace

template <class Scalar, int Dim>
ActiveSet<Scalar, Dim>::ActiveSet(const LbcProblem<Dim>& problem, splitting::Metric metric,
                                  const Settings& settings, ActiveLists active)
    : problem_(problem),
      metric_(std::move(metric)),
      settings_(settings),
      first_active_(std::move(active)) {
}

template <class Scalar, int Dim>
void ActiveSet<Scalar, Dim>::start(const Start<Dim>& start) {
  rebuild(settings_.part * settings_.penalty, settings_.half, std::exchange(first_active_, {}),
          start);
  if (settings_.balances) start_weights_ = start.weights;
}

template <class Scalar, int Dim>
Step ActiveSet<Scalar, Dim>::iterate(int count, bool measure) {
  Step step;
  for (int k = 1; k <= count; ++k) step = splitting_->iterate(measure && k == count);
  return step;
}

template <class Scalar, int Dim>
Start<Dim> ActiveSet<Scalar, Dim>::state() const {
  return splitting_->state().with_penalty(splitting_->penalty() / settings_.part);
}

template <class Scalar, int Dim>
void ActiveSet<Scalar, Dim>::rebuild(double penalty, bool half, ActiveLists active,
                                     const Start<Dim>& from) {
  auto other =
      std::make_unique<Splitting>(problem_, metric_, penalty, settings_.relaxation, half,
                                  std::move(active), splitting::system_matrix(problem_, metric_));
  other->start(from);
  splitting_ = std::move(other);
}

template <class Scalar, int Dim>
int ActiveSet<Scalar, Dim>::adapt(int made, double error, bool ends) {
  int to_make = 0;
  if (ends) {
    to_make = grow(error);
    if (to_make == 0) return 0;
    since_ = made;
  } else if (made == next_balance()) {
    rebuild(balanced_penalty(made), splitting_->stores_half(), splitting_->active(),
            splitting_->state());
    since_ = made;
  } else if (made == since_ + plan::kBetweenLooks) {
    to_make = grow(error);
    since_ = made;
  }
  if (splitting_->stores_half() && plan::trembles(made, error)) {
    rebuild(splitting_->penalty(), false, splitting_->active(), splitting_->state());
    since_ = made;
  }
  return to_make;
}

template <class Scalar, int Dim>
int ActiveSet<Scalar, Dim>::next_balance() const {
  if (!start_weights_) return std::numeric_limits<int>::max();
  return since_ < plan::kFirstBalance ? plan::kFirstBalance : plan::kLastBalance;
}

// As in CompactSplitting::adapt_penalty.
template <class Scalar, int Dim>
double ActiveSet<Scalar, Dim>::balanced_penalty(int made) {
  const auto lengths2 = moved_lengths2(problem_, metric_, start_weights_, splitting_->state());
  if (made >= plan::kLastBalance) start_weights_ = nullptr;
  if (!(lengths2[0] > 0) || !(lengths2[1] > 0)) return splitting_->penalty();
  const double balanced = plan::kBalance * std::sqrt(lengths2[0] / lengths2[1]);
  return settings_.part *
         plan::with_smoothness(std::min(balanced, plan::kLargestPenalty), problem_.smoothness);
}

// Extends the active set if weights at its border exceed a small part of the estimated error or of
// the tolerance, because they would continue beyond. \return iterations to make, 0 if it does not
// grow
template <class Scalar, int Dim>
int ActiveSet<Scalar, Dim>::grow(double error) {
  const double all =
      static_cast<double>(problem_.num_control_points()) * problem_.mesh.num_vertices();
  const auto& active = splitting_->active();
  const auto weight = [&](Index v, Index place) { return splitting_->weight(v, place); };
  const double at_ends = squared_at_ends<Dim>(problem_, active, weight);
  if (!(at_ends > plan::kEndsOfError * error * all)) return 0;
  ++growths_;
  rebuild(splitting_->penalty(), splitting_->stores_half(),
          grown<Dim>(problem_, active, threshold_for(settings_.tolerance), weight),
          splitting_->state());
  return plan::kAfterGrowth;
}

template <class Scalar, int Dim>
void ActiveSet<Scalar, Dim>::describe(SolveReport& report) const {
  report.penalty = splitting_->penalty();
  report.state_scalars_per_cell = splitting_->state_scalars_per_cell();
  report.active_set = {density(problem_, splitting_->active()), growths_};
}

template class ActiveSet<float, 2>;
template class ActiveSet<float, 3>;
template class ActiveSet<double, 2>;
template class ActiveSet<double, 3>;

}  // namespace flbc::active_set

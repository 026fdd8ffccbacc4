// SPDX-License-Identifier: BSD-3-Clause
#include "solver/methods/active_set/active_set.h"

#include <utility>

#include "base/instantiate.h"
#include "solver/plan/constants.h"

namespace flbc::active_set {

template <class Scalar, int Dim>
ActiveSet<Scalar, Dim>::ActiveSet(const LbcProblem<Dim>& problem, splitting::Metric metric,
                                  const Parameters& parameters, ActiveLists active)
    : problem_(problem),
      metric_(std::move(metric)),
      parameters_(parameters),
      splitting_(
          make_splitting(parameters.part * parameters.penalty, parameters.half, std::move(active))),
      rule_(parameters.balances, false, problem.smoothness, parameters.part) {
}

template <class Scalar, int Dim>
void ActiveSet<Scalar, Dim>::start(const Start<Dim>& start) {
  splitting_->start(start, parameters_.balances);
}

template <class Scalar, int Dim>
Step ActiveSet<Scalar, Dim>::iterate(int made, int count, bool measure) {
  for (int k = 1; k < count; ++k) splitting_->iterate(false);
  return splitting_->iterate(measure, rule_.due(made + count));
}

template <class Scalar, int Dim>
Start<Dim> ActiveSet<Scalar, Dim>::state() const {
  return splitting_->state().with_penalty(splitting_->penalty() / parameters_.part);
}

template <class Scalar, int Dim>
std::unique_ptr<ActiveSplitting<Scalar, Dim>> ActiveSet<Scalar, Dim>::make_splitting(
    double penalty, bool half, ActiveLists active) const {
  return std::make_unique<ActiveSplitting<Scalar, Dim>>(
      problem_, metric_, penalty, parameters_.relaxation, half, std::move(active),
      splitting::system_matrix(problem_, metric_));
}

template <class Scalar, int Dim>
int ActiveSet<Scalar, Dim>::adapt(const Milestone& at) {
  int to_make = 0;
  if (rule_.due(at.made) != splitting::Due::kNothing) {
    splitting_->set_penalty(
        rule_.balanced(splitting_->penalty(), splitting_->lengths_since_start()));
    since_ = at.made;
  }
  if (at.ends || at.made == since_ + plan::kBetweenLooks) {
    to_make = grow(at);
    since_ = at.made;
  }
  if (splitting_->stores_half() && plan::ends_half_precision(at.made, at.error))
    splitting_->store_in_single();
  return to_make;
}

// Extends the active set if weights at its border exceed a small part of the estimated error,
// because they would continue beyond. \return iterations to make, 0 if it does not grow
template <class Scalar, int Dim>
int ActiveSet<Scalar, Dim>::grow(const Milestone& at) {
  const double all =
      static_cast<double>(problem_.num_control_points()) * problem_.mesh.num_vertices();
  const auto& active = splitting_->active();
  const auto weight = [&](Index v, Index place) { return splitting_->weight(v, place); };
  const double at_ends = squared_at_ends<Dim>(problem_, active, weight);
  if (!(at_ends > plan::kEndsOfError * at.error * all)) return 0;
  auto more = grown<Dim>(problem_, active, threshold_for(at.tolerance), weight);
  if (more.items.size() == active.items.size()) return 0;
  ++growths_;
  auto larger = make_splitting(splitting_->penalty(), splitting_->stores_half(), std::move(more));
  larger->start(splitting_->state());
  splitting_ = std::move(larger);
  return plan::kAfterGrowth;
}

template <class Scalar, int Dim>
void ActiveSet<Scalar, Dim>::describe(SolveReport& report) const {
  report.penalty = splitting_->penalty();
  report.state_scalars_per_cell = splitting_->state_scalars_per_cell();
  report.active_set = {density(problem_, splitting_->active()), growths_};
}

FLBC_INSTANTIATE_SCALAR_CLASS(ActiveSet)

}  // namespace flbc::active_set

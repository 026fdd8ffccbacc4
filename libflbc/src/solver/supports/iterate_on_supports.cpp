// SPDX-License-Identifier: BSD-3-Clause
#include "solver/supports/iterate_on_supports.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace flbc::supports {

namespace {

template <class Splitting>
WeightInList weights_of(const Splitting& splitting) {
  return [&](Index v, Index place) { return splitting.weight(v, place); };
}

}  // namespace

template <class Scalar, int Dim>
template <class Stored>
std::shared_ptr<SupportSplitting<Scalar, Stored, Dim>> Iteration<Scalar, Dim>::make(
    const DualStart<Dim>& start, double penalty, SupportLists lists) const {
  auto splitting = std::make_shared<Splitting<Stored>>(problem_, metric_, penalty,
                                                       options_.relaxation, std::move(lists));
  splitting->start_from_duals(start.weights, start.flux_density, start.vertex_dual_at(penalty));
  return splitting;
}

template <class Scalar, int Dim>
template <class Stored>
LastState<Dim> Iteration<Scalar, Dim>::run(DualStart<Dim> start, double penalty, SupportLists lists,
                                           const std::function<void()>& started) {
  auto splitting = make<Stored>(start, penalty, std::move(lists));
  start = {};
  started();
  return advance<Stored>(std::move(splitting), 0);
}

// The run is certified from some iteration on, for which all duals are needed.
template <class Scalar, int Dim>
int Iteration<Scalar, Dim>::latest() const {
  return *options_.gap > 0 ? kFirstCertified - 1 : std::numeric_limits<int>::max();
}

// Where weights at the ends of supports are more than a small part of the error there is, or of the
// one wanted, they would go on beyond.
template <class Scalar, int Dim>
template <class Stored>
bool Iteration<Scalar, Dim>::reaches_ends(const Splitting<Stored>& splitting) const {
  constexpr double kPart = 0.1;
  const double error = options_.tolerance * std::max(1.0, report_.primal_residual);
  const double all =
      static_cast<double>(problem_.num_control_points()) * problem_.mesh.num_vertices();
  return squared_at_ends(problem_, splitting.supports(), weights_of(splitting)) >
         kPart * error * all;
}

template <class Scalar, int Dim>
template <class Stored>
LastState<Dim> Iteration<Scalar, Dim>::advance(std::shared_ptr<Splitting<Stored>> splitting,
                                               int earliest) {
  constexpr int kBetweenLooks = 30;
  // As many as it takes for weights to spread to a neighbour and settle there.
  constexpr int kAfterGrowth = 20;
  const auto state = [&] {
    return start_of<Dim>(std::shared_ptr<const Splitting<Stored>>(splitting));
  };
  const auto no_certificate = [](const WeightMatrix&) { return Certificate{}; };
  for (;;) {
    const int pause = std::min(latest(), report_.iterations + kBetweenLooks);
    const auto outcome = run_.iterate(*splitting, no_certificate, {earliest, pause});
    report_.active_pairs.density = density(problem_, splitting->supports());
    report_.state_scalars_per_cell = splitting->state_scalars_per_cell();
    if (outcome == Outcome::kPaused && pause == latest()) return {false, {}, state()};
    if (outcome == Outcome::kTrembles) {
      if constexpr (Splitting<Stored>::kStoresHalf) {
        return advance<Scalar>(make<Scalar>(state(), splitting->penalty(), splitting->supports()),
                               earliest);
      }
    }
    const bool ended = outcome == Outcome::kEnded;
    if ((ended && report_.status != SolveStatus::kConverged) || !reaches_ends(*splitting)) {
      if (ended) return {true, splitting->weights(), state()};
      continue;
    }
    ++report_.active_pairs.growths;
    splitting = make<Stored>(state(), splitting->penalty(),
                             grown(problem_, splitting->supports(),
                                   threshold_for(options_.tolerance), weights_of(*splitting)));
    earliest = report_.iterations + kAfterGrowth;
  }
}

#define FLBC_INSTANTIATE(Dim)                                                                     \
  template LastState<Dim> Iteration<float, Dim>::run<compact::Half>(                              \
      DualStart<Dim>, double, SupportLists, const std::function<void()>&);                        \
  template LastState<Dim> Iteration<float, Dim>::run<float>(DualStart<Dim>, double, SupportLists, \
                                                            const std::function<void()>&);        \
  template LastState<Dim> Iteration<double, Dim>::run<double>(                                    \
      DualStart<Dim>, double, SupportLists, const std::function<void()>&);
FLBC_INSTANTIATE(2)
FLBC_INSTANTIATE(3)
#undef FLBC_INSTANTIATE

}  // namespace flbc::supports

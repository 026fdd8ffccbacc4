// SPDX-License-Identifier: BSD-3-Clause
#include "solver/supports/iterate_on_supports.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/parallel.h"
#include "mesh/cell_geometry.h"

namespace flbc::supports {

namespace {

// Squared lengths in the units in which a penalty is their ratio.
struct Lengths2 {
  double dual = 0;
  double motion = 0;
  Lengths2& operator+=(const Lengths2& other) {
    dual += other.dual;
    motion += other.motion;
    return *this;
  }
};

// Of the duals, and of how far the weights are from where they started.
template <int Dim>
Lengths2 moved_lengths2(const LbcProblem<Dim>& problem, const splitting::Metric& metric,
                        const VectorsAt<1>& before, const DualStart<Dim>& now) {
  return parallel_sum(problem.mesh.num_cells(), Lengths2{}, [&](Index begin, Index end) {
    Lengths2 sum;
    for (Index s = begin; s < end; ++s) {
      const auto geometry = cell_geometry(problem.mesh, s);
      Eigen::Matrix<double, Eigen::Dynamic, Dim> motion =
          Eigen::Matrix<double, Eigen::Dynamic, Dim>::Zero(problem.num_control_points(), Dim);
      for (int k = 0; k <= Dim; ++k) {
        const Index v = problem.mesh.cells(k, s);
        if (!problem.boundary.is_interior(v)) continue;
        motion += (now.weights(v) - before(v)) * geometry.hat_gradients.col(k).transpose();
      }
      sum.dual +=
          geometry.measure * geometry.measure / metric.cell[s] * now.flux_density(s).squaredNorm();
      sum.motion += metric.cell[s] * motion.squaredNorm();
    }
    return sum;
  });
}

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
                                           Window window, const std::function<void()>& started) {
  auto splitting = make<Stored>(start, penalty, std::move(lists));
  start = {};
  started();
  return advance<Stored>(std::move(splitting), window);
}

template <class Scalar, int Dim>
template <class Stored>
LastState<Dim> Iteration<Scalar, Dim>::resume(
    double penalty, SupportLists lists, Window window,
    const std::function<void(SupportSplitting<Scalar, Stored, Dim>&)>& read) {
  auto splitting = std::make_shared<Splitting<Stored>>(problem_, metric_, penalty,
                                                       options_.relaxation, std::move(lists));
  read(*splitting);
  return advance<Stored>(std::move(splitting), window);
}

// The run is certified from some iteration on, for which all duals are needed.
template <class Scalar, int Dim>
int Iteration<Scalar, Dim>::latest() const {
  return *options_.gap > 0 ? kFirstCertified - 1 : std::numeric_limits<int>::max();
}

template <class Scalar, int Dim>
int Iteration<Scalar, Dim>::next_balance(int since) const {
  constexpr int kFirstBalance = 10;
  if (!start_weights_) return std::numeric_limits<int>::max();
  return since < kFirstBalance ? kFirstBalance : kLastBalance;
}

// As in CompactSplitting::adapt_penalty.
template <class Scalar, int Dim>
double Iteration<Scalar, Dim>::balanced_penalty(const DualStart<Dim>& state) {
  constexpr double kBalance = 0.3;
  const auto lengths2 = moved_lengths2(problem_, metric_, start_weights_, state);
  if (report_.iterations >= kLastBalance) start_weights_ = nullptr;
  if (!(lengths2.dual > 0) || !(lengths2.motion > 0)) return state.penalty;
  const double balanced = kBalance * std::sqrt(lengths2.dual / lengths2.motion);
  return part_ * std::min(balanced, largest_penalty(problem_));
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
                                               Window window) {
  constexpr int kBetweenLooks = 30;
  // As many as it takes for weights to spread to a neighbour and settle there.
  constexpr int kAfterGrowth = 20;
  const auto state = [&] {
    return start_of<Dim>(std::shared_ptr<const Splitting<Stored>>(splitting));
  };
  const auto no_certificate = [](const WeightMatrix&) { return Certificate{}; };
  for (;; window.since = report_.iterations) {
    const int balance = next_balance(window.since);
    const int pause = std::min({latest(), window.pause, balance, window.since + kBetweenLooks});
    const auto outcome =
        run_.iterate(*splitting, no_certificate, {window.earliest, pause, window.since});
    report_.active_pairs.density = density(problem_, splitting->supports());
    report_.state_scalars_per_cell = splitting->state_scalars_per_cell();
    if (outcome == Outcome::kPaused && pause == window.pause) {
      return {true, splitting->sparse_weights(), state()};
    }
    if (outcome == Outcome::kPaused && pause == latest()) return {false, {}, state()};
    if (outcome == Outcome::kPaused && pause == balance) {
      splitting = make<Stored>(state(), balanced_penalty(state()), splitting->supports());
      continue;
    }
    if (outcome == Outcome::kTrembles) {
      if constexpr (Splitting<Stored>::kStoresHalf) {
        window.since = report_.iterations;
        return advance<Scalar>(make<Scalar>(state(), splitting->penalty(), splitting->supports()),
                               window);
      }
    }
    const bool ended = outcome == Outcome::kEnded;
    if ((ended && report_.status != SolveStatus::kConverged) || !reaches_ends(*splitting)) {
      if (ended) return {true, splitting->sparse_weights(), state()};
      continue;
    }
    ++report_.active_pairs.growths;
    splitting = make<Stored>(state(), splitting->penalty(),
                             grown(problem_, splitting->supports(),
                                   threshold_for(options_.tolerance), weights_of(*splitting)));
    window.earliest = report_.iterations + kAfterGrowth;
  }
}

#define FLBC_RESUME(Scalar, Stored, Dim)                  \
  template LastState<Dim> Iteration<Scalar, Dim>::resume( \
      double, SupportLists, Window,                       \
      const std::function<void(SupportSplitting<Scalar, Stored, Dim>&)>&);
FLBC_RESUME(float, compact::Half, 2)
FLBC_RESUME(float, compact::Half, 3)
FLBC_RESUME(float, float, 2)
FLBC_RESUME(float, float, 3)
FLBC_RESUME(double, double, 2)
FLBC_RESUME(double, double, 3)
#undef FLBC_RESUME

#define FLBC_INSTANTIATE(Dim)                                                                      \
  template LastState<Dim> Iteration<float, Dim>::run<compact::Half>(                               \
      DualStart<Dim>, double, SupportLists, Window, const std::function<void()>&);                 \
  template LastState<Dim> Iteration<float, Dim>::run<float>(DualStart<Dim>, double, SupportLists,  \
                                                            Window, const std::function<void()>&); \
  template LastState<Dim> Iteration<double, Dim>::run<double>(                                     \
      DualStart<Dim>, double, SupportLists, Window, const std::function<void()>&);
FLBC_INSTANTIATE(2)
FLBC_INSTANTIATE(3)
#undef FLBC_INSTANTIATE

}  // namespace flbc::supports

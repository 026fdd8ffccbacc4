// SPDX-License-Identifier: BSD-3-Clause
#include "sparsify/support_selection.h"

#include <algorithm>
#include <utility>

namespace flbc {
namespace {

// Number of further removals to try after a feasible one has been found.
constexpr int kMoreTrials = 3;
// Number of control points tried for insertion at a time.
constexpr std::size_t kNewcomers = 8;
// Smaller slopes are rounding errors.
constexpr double kLeastSlope = 1e-9;

}  // namespace

template <int Dim>
bool SupportSelection<Dim>::reduce(Index count, double bound, PointWeights& weights) {
  while (static_cast<Index>(weights.support.size()) > count) {
    if (!remove_cheapest(bound, weights)) return false;
  }
  return weights.cost < bound;
}

template <int Dim>
bool SupportSelection<Dim>::remove_cheapest(double bound, PointWeights& weights) {
  const auto& costs = qp_.removal_costs(weights);
  removals_.clear();
  for (std::size_t k = 0; k < costs.size(); ++k) {
    removals_.push_back({costs[k], static_cast<Index>(k)});
  }
  // A heap, because few of them are tried.
  const auto is_later = [](const Candidate& a, const Candidate& b) { return b < a; };
  std::make_heap(removals_.begin(), removals_.end(), is_later);
  bool found = false;
  int trials = 0;
  for (auto end = removals_.end(); end != removals_.begin(); --end) {
    std::pop_heap(removals_.begin(), end, is_later);
    const auto [cost, position] = *(end - 1);
    // These costs are lower bounds of the true ones.
    if (weights.cost + cost >= bound || (found && trials++ >= kMoreTrials)) break;
    support_ = weights.support;
    support_.erase(support_.begin() + position);
    if (!qp_.solve(support_, bound, trial_) || trial_.cost >= bound) continue;
    std::swap(least_, trial_);
    bound = least_.cost;
    found = true;
  }
  if (found) std::swap(weights, least_);
  return found;
}

template <int Dim>
void SupportSelection<Dim>::adopt(const std::vector<Index>& support, double least_gain,
                                  PointWeights& weights) {
  // The weights are already optimal on their support.
  if (std::includes(weights.support.begin(), weights.support.end(), support.begin(),
                    support.end())) {
    return;
  }
  const double bound = weights.cost - least_gain;
  if (qp_.solve(support, bound, trial_) && trial_.cost < bound) std::swap(weights, trial_);
}

template <int Dim>
void SupportSelection<Dim>::exchange(Index count, double least_gain,
                                     const std::vector<Index>& may_enter, PointWeights& weights) {
  do {
    find_newcomers(may_enter, weights);
  } while (exchange_one(count, least_gain, weights));
}

template <int Dim>
bool SupportSelection<Dim>::exchange_one(Index count, double least_gain, PointWeights& weights) {
  const double bound = weights.cost - least_gain;
  for (const auto& newcomer : newcomers_) {
    // The constraint w >= 0 and a removal can only decrease the gain.
    if (weights.cost + newcomer.cost >= bound) break;
    exchanged_ = weights;
    qp_.descend(exchanged_, newcomer.number);
    // The cost is now minimal; a removal can only increase it.
    if (exchanged_.cost >= bound || !reduce(count, bound, exchanged_)) continue;
    std::swap(weights, exchanged_);
    return true;
  }
  return false;
}

// The control points that would decrease the cost most, ignoring w >= 0.
template <int Dim>
void SupportSelection<Dim>::find_newcomers(const std::vector<Index>& may_enter,
                                           const PointWeights& weights) {
  newcomers_.clear();
  if (!qp_.settle(weights)) return;
  for (const Index i : may_enter) {
    if (std::binary_search(weights.support.begin(), weights.support.end(), i)) continue;
    const double slope = qp_.slope(weights, i);
    if (slope < -kLeastSlope) newcomers_.push_back({-qp_.gain(slope, i), i});
  }
  const std::size_t kept = std::min(kNewcomers, newcomers_.size());
  std::partial_sort(newcomers_.begin(), newcomers_.begin() + static_cast<std::ptrdiff_t>(kept),
                    newcomers_.end());
  newcomers_.resize(kept);
}

template class SupportSelection<2>;
template class SupportSelection<3>;

}  // namespace flbc

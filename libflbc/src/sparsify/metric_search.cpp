// SPDX-License-Identifier: BSD-3-Clause
#include "sparsify/metric_search.h"

#include <algorithm>
#include <utility>

namespace flbc {
namespace {

// Influences whose removal is tried after one has been found that can go.
constexpr int kMoreTrials = 3;
// Control points tried as newcomers at a time.
constexpr std::size_t kNewcomers = 4;
// Slopes that rounding explains.
constexpr double kFlat = 1e-9;

}  // namespace

template <int Dim>
bool MetricSearch<Dim>::reduce(Index count, double bound, SparseRow& row) {
  while (static_cast<Index>(row.support.size()) > count) {
    if (!remove_cheapest(bound, row)) return false;
  }
  return row.cost < bound;
}

template <int Dim>
bool MetricSearch<Dim>::remove_cheapest(double bound, SparseRow& row) {
  const auto& costs = row_.removal_costs(row);
  removals_.clear();
  for (std::size_t k = 0; k < costs.size(); ++k) {
    removals_.push_back({costs[k], static_cast<Index>(k)});
  }
  std::sort(removals_.begin(), removals_.end(), [](const Candidate& a, const Candidate& b) {
    return a.cost != b.cost ? a.cost < b.cost : a.number < b.number;
  });
  bool found = false;
  int trials = 0;
  for (const auto& [cost, position] : removals_) {
    // These costs are lower bounds of the true ones.
    if (row.cost + cost >= bound || (found && trials++ >= kMoreTrials)) break;
    support_ = row.support;
    support_.erase(support_.begin() + position);
    if (!row_.solve(support_, bound, trial_) || trial_.cost >= bound) continue;
    std::swap(least_, trial_);
    bound = least_.cost;
    found = true;
  }
  if (found) std::swap(row, least_);
  return found;
}

template <int Dim>
void MetricSearch<Dim>::adopt(const std::vector<Index>& support, double least_gain,
                              SparseRow& row) {
  // The row is already the best one on its own support.
  if (std::includes(row.support.begin(), row.support.end(), support.begin(), support.end())) return;
  const double bound = row.cost - least_gain;
  if (row_.solve(support, bound, trial_) && trial_.cost < bound) std::swap(row, trial_);
}

template <int Dim>
void MetricSearch<Dim>::exchange(Index count, double least_gain, const std::vector<bool>& may_enter,
                                 SparseRow& row) {
  do {
    find_newcomers(may_enter, row);
  } while (exchange_one(count, least_gain, row));
}

template <int Dim>
bool MetricSearch<Dim>::exchange_one(Index count, double least_gain, SparseRow& row) {
  const double bound = row.cost - least_gain;
  for (const auto& newcomer : newcomers_) {
    exchanged_ = row;
    row_.descend(exchanged_, newcomer.number);
    // Now the cost is least; removing one can only raise it.
    if (exchanged_.cost >= bound || !reduce(count, bound, exchanged_)) continue;
    std::swap(row, exchanged_);
    return true;
  }
  return false;
}

// The control points that would bring the cost down most, as far as their slopes tell.
template <int Dim>
void MetricSearch<Dim>::find_newcomers(const std::vector<bool>& may_enter, const SparseRow& row) {
  const Eigen::VectorXd& slopes = row_.slopes(row);
  newcomers_.clear();
  for (Index i = 0; i < static_cast<Index>(slopes.size()); ++i) {
    if (!(slopes[i] < -kFlat) || !may_enter[i]) continue;
    if (std::binary_search(row.support.begin(), row.support.end(), i)) continue;
    newcomers_.push_back({-slopes[i] * slopes[i] / metric_(i, i), i});
  }
  const std::size_t kept = std::min(kNewcomers, newcomers_.size());
  std::partial_sort(newcomers_.begin(), newcomers_.begin() + static_cast<std::ptrdiff_t>(kept),
                    newcomers_.end(), [](const Candidate& a, const Candidate& b) {
                      return a.cost != b.cost ? a.cost < b.cost : a.number < b.number;
                    });
  newcomers_.resize(kept);
}

template class MetricSearch<2>;
template class MetricSearch<3>;

}  // namespace flbc

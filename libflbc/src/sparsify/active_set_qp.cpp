// SPDX-License-Identifier: BSD-3-Clause
#include "sparsify/active_set_qp.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace flbc {
namespace {

// Errors of sum and reproduction that are none for the purpose of a choice.
constexpr double kFeasible = 1e-8;
// Weights below this are none.
constexpr double kZero = 1e-12;
// Slopes that rounding explains.
constexpr double kFlat = 1e-10;

template <class List>
void erase_at(List& list, std::size_t position) {
  list.erase(list.begin() + static_cast<std::ptrdiff_t>(position));
}

}  // namespace

template <int Dim>
double MetricRow<Dim>::cost_of(const SparseRow& row) const {
  double cost = 0;
  for (std::size_t k = 0; k < row.support.size(); ++k) {
    double slope = -2 * free_.pull()[row.support[k]];
    for (std::size_t l = 0; l < row.support.size(); ++l) {
      slope += free_.metric()(row.support[l], row.support[k]) * row.weights[l];
    }
    cost += slope * row.weights[k];
  }
  return cost;
}

template <int Dim>
bool MetricRow<Dim>::solve(const std::vector<Index>& support, double bound, SparseRow& row) {
  if (!drop_negative(support, bound) || !is_feasible()) return false;
  if (!left_.empty()) descend_to_minimum();
  return finish(row);
}

// The quickest way to feasible weights: to leave out what would be negative. Without w >= 0 the
// cost is least, which bounds it from below.
template <int Dim>
bool MetricRow<Dim>::drop_negative(const std::vector<Index>& support, double bound) {
  members_ = support;
  left_.clear();
  while (!members_.empty() && free_.minimize(members_)) {
    if (left_.empty() && free_.cost() >= bound) return false;
    weights_ = free_.weights();
    const auto lowest = std::min_element(weights_.begin(), weights_.end());
    if (*lowest > kZero) return true;
    const auto position = static_cast<std::size_t>(lowest - weights_.begin());
    left_.push_back(members_[position]);
    erase_at(members_, position);
  }
  return false;
}

template <int Dim>
void MetricRow<Dim>::descend(SparseRow& row, Index newcomer) {
  members_ = row.support;
  weights_ = row.weights;
  left_.clear();
  if (newcomer >= 0) {
    members_.push_back(newcomer);
    weights_.push_back(0);
  }
  descend_to_minimum();
  row.cost = cost_of(row);
  if (finish(lower_) && lower_.cost < row.cost) std::swap(row, lower_);
}

// Primal active set method: towards the free minimum; whose weight reaches zero on the way leaves,
// and at the minimum those come back whose weights would grow.
template <int Dim>
void MetricRow<Dim>::descend_to_minimum() {
  // Far more rounds than it takes: with rounding it might turn in circles.
  const std::size_t rounds = 4 * (members_.size() + left_.size()) + 8;
  for (std::size_t round = 0; round < rounds; ++round) {
    if (!free_.minimize(members_)) return;
    const std::size_t first = step_to_free_minimum();
    if (first < members_.size()) {
      left_.push_back(members_[first]);
      erase_at(members_, first);
      erase_at(weights_, first);
      continue;
    }
    const std::size_t back = most_wanted();
    if (back == left_.size()) return;
    members_.push_back(left_[back]);
    weights_.push_back(0);
    erase_at(left_, back);
  }
}

// \return who reached zero first, or the number of members
template <int Dim>
std::size_t MetricRow<Dim>::step_to_free_minimum() {
  const auto& wanted = free_.weights();
  double step = 1;
  std::size_t first = members_.size();
  for (std::size_t k = 0; k < members_.size(); ++k) {
    if (wanted[k] > kZero) continue;
    const double reach = weights_[k] / std::max(weights_[k] - wanted[k], kZero);
    if (reach < step) {
      step = reach;
      first = k;
    }
  }
  for (std::size_t k = 0; k < members_.size(); ++k) {
    weights_[k] += step * (wanted[k] - weights_[k]);
  }
  return first;
}

// \return whose weight would grow most, of those who left, or their number
template <int Dim>
std::size_t MetricRow<Dim>::most_wanted() const {
  double steepest = -kFlat;
  std::size_t best = left_.size();
  for (std::size_t k = 0; k < left_.size(); ++k) {
    const Index i = left_[k];
    double slope = -free_.pull()[i] - free_.constraint(i).dot(free_.multipliers());
    for (std::size_t l = 0; l < members_.size(); ++l) {
      slope += free_.metric()(members_[l], i) * weights_[l];
    }
    if (slope < steepest) {
      steepest = slope;
      best = k;
    }
  }
  return best;
}

template <int Dim>
bool MetricRow<Dim>::is_feasible() const {
  Sums sums = -Sums::Unit(0);
  for (std::size_t k = 0; k < members_.size(); ++k) {
    sums += weights_[k] * free_.constraint(members_[k]);
  }
  return sums.norm() <= kFeasible;
}

// Members and weights as a row. \return false if they are not feasible
template <int Dim>
bool MetricRow<Dim>::finish(SparseRow& row) {
  if (!is_feasible()) return false;
  order_.resize(members_.size());
  std::iota(order_.begin(), order_.end(), 0);
  std::sort(order_.begin(), order_.end(),
            [&](std::size_t a, std::size_t b) { return members_[a] < members_[b]; });
  row.support.clear();
  row.weights.clear();
  for (const std::size_t k : order_) {
    if (weights_[k] <= kZero) continue;
    row.support.push_back(members_[k]);
    row.weights.push_back(weights_[k]);
  }
  row.cost = cost_of(row);
  return true;
}

template <int Dim>
const Eigen::VectorXd& MetricRow<Dim>::slopes(const SparseRow& row) {
  if (!free_.minimize(row.support)) {
    return slopes_ = Eigen::VectorXd::Zero(free_.metric().rows());
  }
  slopes_ = -free_.pull() - free_.absorbed();
  for (std::size_t k = 0; k < row.support.size(); ++k) {
    slopes_ += row.weights[k] * free_.metric().col(row.support[k]);
  }
  return slopes_;
}

template <int Dim>
const std::vector<double>& MetricRow<Dim>::removal_costs(const SparseRow& row) {
  if (!free_.minimize(row.support)) {
    removal_costs_.assign(row.support.size(), 0);
    return removal_costs_;
  }
  free_.removal_costs(removal_costs_);
  for (std::size_t k = 0; k < removal_costs_.size(); ++k) {
    removal_costs_[k] *= row.weights[k] * row.weights[k];
  }
  return removal_costs_;
}

template class MetricRow<2>;
template class MetricRow<3>;

}  // namespace flbc

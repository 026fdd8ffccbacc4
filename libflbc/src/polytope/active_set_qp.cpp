// SPDX-License-Identifier: BSD-3-Clause
#include "polytope/active_set_qp.h"

#include <algorithm>
#include <utility>

#include "polytope/nearest_point_in_hull.h"

namespace flbc {
namespace {

// Feasibility tolerance on partition of unity and reproduction.
constexpr double kFeasible = 1e-8;
// Smaller weights count as 0.
constexpr double kNegligible = 1e-12;
// Smaller slopes are rounding errors.
constexpr double kFlat = 1e-10;

template <class List>
void erase_at(List& list, std::size_t position) {
  list.erase(list.begin() + static_cast<std::ptrdiff_t>(position));
}

}  // namespace

template <int Dim>
Eigen::VectorXd& ActiveSetQp<Dim>::aim_at(const Vector<Dim>& point) {
  point_ = point;
  return free_.aim_at(point);
}

template <int Dim>
double ActiveSetQp<Dim>::cost_of(const PointWeights& weights) const {
  double cost = 0;
  for (std::size_t k = 0; k < weights.support.size(); ++k) {
    double slope = -2 * free_.pull()[weights.support[k]];
    if (metric().is_identity()) {
      slope += weights.values[k];
    } else {
      for (std::size_t l = 0; l < weights.support.size(); ++l) {
        slope += metric()(weights.support[l], weights.support[k]) * weights.values[l];
      }
    }
    cost += slope * weights.values[k];
  }
  return cost;
}

template <int Dim>
bool ActiveSetQp<Dim>::solve(const std::vector<Index>& support, double bound,
                             PointWeights& weights) {
  // The minimum without w >= 0 is a lower bound of the cost.
  if (!free_.minimize(support) || free_.cost() >= bound) return false;
  if (!start_without_negative(support)) {
    // With as many control points as constraints there is no choice.
    if (support.size() <= Dim + 1 || !start_in_hull(support)) return false;
  }
  at_minimum_ = true;
  if (!left_.empty()) {
    descend_to_minimum();
    if (!is_feasible()) return false;
  }
  finish(weights);
  return true;
}

// Fast search for feasible weights: repeatedly removes the most negative weight of the free
// minimum. It may fail.
template <int Dim>
bool ActiveSetQp<Dim>::start_without_negative(const std::vector<Index>& support) {
  members_ = support;
  left_.clear();
  for (;;) {
    weights_ = free_.weights();
    const auto lowest = std::min_element(weights_.begin(), weights_.end());
    if (*lowest > kNegligible) return is_feasible();
    const auto position = static_cast<std::size_t>(lowest - weights_.begin());
    left_.push_back(members_[position]);
    erase_at(members_, position);
    if (members_.empty() || !free_.minimize(members_)) return false;
  }
}

// Reliable search for feasible weights: the few control points around the point by Caratheodory's
// theorem.
template <int Dim>
bool ActiveSetQp<Dim>::start_in_hull(const std::vector<Index>& support) {
  const PointList<Dim> carriers = control_points_(Eigen::all, support);
  const auto nearest = nearest_point_in_hull<Dim>(carriers, point_);
  left_ = support;
  members_.clear();
  weights_.clear();
  for (int k = 0; k < nearest.size; ++k) {
    const Index member = support[nearest.support[k]];
    enter(member, nearest.weights[k]);
    left_.erase(std::find(left_.begin(), left_.end(), member));
  }
  return is_feasible();
}

template <int Dim>
void ActiveSetQp<Dim>::descend(PointWeights& weights, Index newcomer) {
  members_ = weights.support;
  weights_ = weights.values;
  left_.clear();
  if (newcomer >= 0) enter(newcomer, 0);
  descend_to_minimum();
  if (!is_feasible()) return;
  finish(lower_);
  if (lower_.cost < weights.cost) std::swap(weights, lower_);
}

// Moves toward the free minimum. A control point whose weight reaches zero is removed; at the
// minimum, control points whose weights would grow return.
template <int Dim>
void ActiveSetQp<Dim>::descend_to_minimum() {
  // Far more iterations than needed, because rounding might cause cycles.
  const std::size_t rounds = 4 * (members_.size() + left_.size()) + 8;
  for (std::size_t round = 0; round < rounds; ++round) {
    at_minimum_ = false;
    if (!free_.minimize(members_)) return;
    const std::size_t first = step_to_free_minimum();
    if (first < members_.size()) {
      left_.push_back(members_[first]);
      erase_at(members_, first);
      erase_at(weights_, first);
      continue;
    }
    at_minimum_ = true;
    const std::size_t back = most_wanted();
    if (back == left_.size()) return;
    enter(left_[back], 0);
    erase_at(left_, back);
  }
}

template <int Dim>
void ActiveSetQp<Dim>::enter(Index control_point, double weight) {
  const auto place = std::upper_bound(members_.begin(), members_.end(), control_point);
  weights_.insert(weights_.begin() + (place - members_.begin()), weight);
  members_.insert(place, control_point);
}

// \return the member that reached zero first, or the number of members
template <int Dim>
std::size_t ActiveSetQp<Dim>::step_to_free_minimum() {
  const auto& wanted = free_.weights();
  double step = 1;
  std::size_t first = members_.size();
  for (std::size_t k = 0; k < members_.size(); ++k) {
    if (wanted[k] > kNegligible) continue;
    const double reach = weights_[k] / std::max(weights_[k] - wanted[k], kNegligible);
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

// \return the removed control point whose weight would grow most, or their number
template <int Dim>
std::size_t ActiveSetQp<Dim>::most_wanted() const {
  double steepest = -kFlat;
  std::size_t best = left_.size();
  for (std::size_t k = 0; k < left_.size(); ++k) {
    const double slope_of_it = slope(members_, weights_, left_[k]);
    if (slope_of_it < steepest) {
      steepest = slope_of_it;
      best = k;
    }
  }
  return best;
}

template <int Dim>
bool ActiveSetQp<Dim>::is_feasible() const {
  Sums sums = -Sums::Unit(0);
  for (std::size_t k = 0; k < members_.size(); ++k) {
    sums += weights_[k] * free_.constraint(members_[k]);
  }
  return sums.norm() <= kFeasible;
}

// \param weights  those of the members, without negligible ones
template <int Dim>
void ActiveSetQp<Dim>::finish(PointWeights& weights) const {
  weights.support.clear();
  weights.values.clear();
  for (std::size_t k = 0; k < members_.size(); ++k) {
    if (weights_[k] <= kNegligible) continue;
    weights.support.push_back(members_[k]);
    weights.values.push_back(weights_[k]);
  }
  weights.cost =
      at_minimum_ && weights.support.size() == members_.size() ? free_.cost() : cost_of(weights);
}

template <int Dim>
double ActiveSetQp<Dim>::slope(const PointWeights& weights, Index newcomer) const {
  return slope(weights.support, weights.values, newcomer);
}

template <int Dim>
double ActiveSetQp<Dim>::slope(const std::vector<Index>& members,
                               const std::vector<double>& weights, Index outside) const {
  double slope = -free_.pull()[outside] - free_.constraint(outside).dot(free_.multipliers());
  if (metric().is_identity()) return slope;
  for (std::size_t l = 0; l < members.size(); ++l) {
    slope += metric()(members[l], outside) * weights[l];
  }
  return slope;
}

template <int Dim>
const std::vector<double>& ActiveSetQp<Dim>::removal_costs(const PointWeights& weights) {
  if (!free_.minimize(weights.support)) {
    removal_costs_.assign(weights.support.size(), 0);
    return removal_costs_;
  }
  removal_costs_ = free_.removal_costs();
  for (std::size_t k = 0; k < removal_costs_.size(); ++k) {
    removal_costs_[k] *= weights.values[k] * weights.values[k];
  }
  return removal_costs_;
}

template class ActiveSetQp<2>;
template class ActiveSetQp<3>;

}  // namespace flbc

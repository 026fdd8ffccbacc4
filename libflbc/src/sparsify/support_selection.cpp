// SPDX-License-Identifier: BSD-3-Clause
#include "sparsify/support_selection.h"

#include <algorithm>
#include <limits>

#include <Eigen/LU>

namespace flbc {
namespace {

// Errors of sum and reproduction that are none for the purpose of a choice.
constexpr double kFeasible = 1e-7;
// Weights below this are none.
constexpr double kZero = 1e-12;
// Keeps the normal matrix regular for control points in a line or plane.
constexpr double kRidge = 1e-13;
// Influences whose removal is computed exactly before one is taken whose removal is easy.
constexpr int kExactTrials = 4;
// Newcomers must have had this weight: what has next to no influence is far away as a rule, and
// bends of the cage move it otherwise than what is near.
constexpr double kInfluence = 1e-3;
// Exchanges, and the newcomers tried for each.
constexpr int kExchanges = 4;
constexpr std::size_t kNewcomers = 8;

}  // namespace

template <int Dim>
SupportSearch<Dim>::SupportSearch(const PointList<Dim>& control_points, double size,
                                  const Vector<Dim>& point, const Eigen::VectorXd& row)
    : rows_(control_points.cols(), Dim + 1), row_(row) {
  rows_.col(0).setOnes();
  rows_.template rightCols<Dim>() = ((control_points.colwise() - point) / size).transpose();
}

template <int Dim>
bool SupportSearch<Dim>::solve(const std::vector<Index>& support, Choice& choice) const {
  const auto count = static_cast<Index>(support.size());
  Basis rows(count, Dim + 1);
  Eigen::VectorXd row(count);
  for (Index k = 0; k < count; ++k) {
    rows.row(k) = rows_.row(support[k]);
    row[k] = row_[support[k]];
  }
  const Sums sums = Sums::Unit(0);
  DualNewton<Dim> newton(rows);
  // Not reaching the minimum shows in the sums.
  newton.minimize(row, sums, kRidge);
  const Eigen::VectorXd weights = newton.row().cwiseMax(0);
  if (!((rows.transpose() * weights - sums).norm() <= kFeasible)) return false;

  choice.support.clear();
  choice.weights.resize(count);
  choice.cost = 0;
  Index kept = 0;
  for (Index k = 0; k < count; ++k) {
    if (weights[k] <= kZero) continue;
    choice.support.push_back(support[k]);
    choice.weights[kept++] = weights[k];
    choice.cost += weights[k] * (weights[k] - 2 * row[k]);
  }
  choice.weights.conservativeResize(kept);
  return true;
}

template <int Dim>
bool SupportSearch<Dim>::reduce(Index count, Choice& choice) const {
  while (static_cast<Index>(choice.support.size()) > count) {
    if (!remove_cheapest(choice)) return false;
  }
  return true;
}

template <int Dim>
typename SupportSearch<Dim>::Square SupportSearch<Dim>::inverse_gram(const Choice& choice) const {
  Square gram = Square::Zero();
  for (const Index i : choice.support) {
    const Sums q = rows_.row(i).transpose();
    gram.noalias() += q * q.transpose();
  }
  gram.diagonal().array() += kRidge * gram.trace();
  return gram.inverse();
}

// Without w >= 0 the removal of influence i costs w_i^2 / (1 - h_ii), h = Q (Q^T Q)^-1 Q^T. That is
// a lower bound of its true cost, and the true cost if no other weight becomes negative.
template <int Dim>
bool SupportSearch<Dim>::remove_cheapest(Choice& choice) const {
  const Square inverse = inverse_gram(choice);
  const auto count = static_cast<Index>(choice.support.size());
  std::vector<Removal> removals(count);
  for (Index k = 0; k < count; ++k) {
    const Sums q = rows_.row(choice.support[k]).transpose();
    const double freedom = std::max(kRidge, 1 - q.dot(inverse * q));
    removals[k] = {choice.weights[k] * choice.weights[k] / freedom, k};
  }
  std::sort(removals.begin(), removals.end(), [](const Removal& a, const Removal& b) {
    return a.cost != b.cost ? a.cost < b.cost : a.position < b.position;
  });

  Choice best, trial;
  best.cost = std::numeric_limits<double>::infinity();
  int exact_trials = 0;
  for (const Removal& removal : removals) {
    if (choice.cost + removal.cost >= best.cost) break;
    if (remove_plainly(choice, inverse, removal, trial)) {
      best = std::move(trial);
      break;
    }
    if (exact_trials++ >= kExactTrials && !best.support.empty()) continue;
    auto support = choice.support;
    support.erase(support.begin() + removal.position);
    if (solve(support, trial) && trial.cost < best.cost) best = trial;
  }
  if (best.support.empty()) return false;
  choice = std::move(best);
  return true;
}

// \return false if another weight would become negative
template <int Dim>
bool SupportSearch<Dim>::remove_plainly(const Choice& choice, const Square& inverse,
                                        const Removal& removal, Choice& result) const {
  const Index gone = removal.position;
  const Sums q = inverse * rows_.row(choice.support[gone]).transpose();
  const double freedom = 1 - rows_.row(choice.support[gone]).dot(q);
  // Next to nothing: rounding would decide.
  if (freedom < 1e-6) return false;
  const double share = choice.weights[gone] / freedom;
  const auto count = static_cast<Index>(choice.support.size());
  result.support.clear();
  result.weights.resize(count - 1);
  for (Index k = 0; k < count; ++k) {
    if (k == gone) continue;
    const double weight = choice.weights[k] + share * rows_.row(choice.support[k]).dot(q);
    if (weight <= kZero) return false;
    result.weights[static_cast<Index>(result.support.size())] = weight;
    result.support.push_back(choice.support[k]);
  }
  result.cost = choice.cost + removal.cost;
  return true;
}

template <int Dim>
void SupportSearch<Dim>::exchange(Index count, Choice& choice) const {
  Choice trial;
  for (int round = 0; round < kExchanges; ++round) {
    bool improved = false;
    for (const Index newcomer : most_promising(choice)) {
      auto support = choice.support;
      support.insert(std::upper_bound(support.begin(), support.end(), newcomer), newcomer);
      if (!solve(support, trial) || !reduce(count, trial)) continue;
      // By more than the errors of both.
      improved = trial.cost < choice.cost - 1e-9;
      if (improved) break;
    }
    if (!improved) return;
    choice = trial;
  }
}

// The control points with which the cost would fall most, w >= 0 left aside. At the nearest weights
// w = y + Q mu on the support; elsewhere y + Q mu says what a weight would like to become.
template <int Dim>
std::vector<Index> SupportSearch<Dim>::most_promising(const Choice& choice) const {
  const Square inverse = inverse_gram(choice);
  Sums right = Sums::Zero();
  for (std::size_t k = 0; k < choice.support.size(); ++k) {
    const Index i = choice.support[k];
    right += (choice.weights[k] - row_[i]) * rows_.row(i).transpose();
  }
  const Sums mu = inverse * right;
  std::vector<Removal> gains;
  for (Index i = 0; i < static_cast<Index>(rows_.rows()); ++i) {
    const Sums q = rows_.row(i).transpose();
    const double wish = row_[i] + q.dot(mu);
    if (wish <= 0 || row_[i] < kInfluence ||
        std::binary_search(choice.support.begin(), choice.support.end(), i)) {
      continue;
    }
    gains.push_back({-wish * wish / (1 + q.dot(inverse * q)), i});
  }
  std::sort(gains.begin(), gains.end(), [](const Removal& a, const Removal& b) {
    return a.cost != b.cost ? a.cost < b.cost : a.position < b.position;
  });
  std::vector<Index> best;
  for (std::size_t k = 0; k < std::min(kNewcomers, gains.size()); ++k) {
    best.push_back(gains[k].position);
  }
  return best;
}

template class SupportSearch<2>;
template class SupportSearch<3>;

}  // namespace flbc

// SPDX-License-Identifier: BSD-3-Clause
#include "sparsify/point_sparsifier.h"

#include <algorithm>
#include <limits>

#include "polytope/nearest_point_in_hull.h"
#include "polytope/scaling.h"

namespace flbc {
namespace {

// Minimum decrease of |w - given|^2 by an exchange, above rounding errors.
constexpr double kLeastGain = 1e-9;
constexpr double kNoBound = std::numeric_limits<double>::infinity();

Index count(const std::vector<Index>& support) {
  return static_cast<Index>(support.size());
}

// The influences, largest first.
std::vector<Index> by_size(const Eigen::VectorXd& weights) {
  auto support = positive_entries(weights);
  std::stable_sort(support.begin(), support.end(),
                   [&](Index a, Index b) { return weights[a] > weights[b]; });
  return support;
}

}  // namespace

Eigen::VectorXd to_dense(const PointWeights& few, Eigen::Index size) {
  Eigen::VectorXd weights = Eigen::VectorXd::Zero(size);
  for (std::size_t k = 0; k < few.support.size(); ++k) weights[few.support[k]] = few.values[k];
  return weights;
}

template <int Dim>
Eigen::VectorXd PointSparsifier<Dim>::sparsify(const Vector<Dim>& point,
                                               const Eigen::VectorXd& given,
                                               const Eigen::VectorXd& projected,
                                               Workspace& work) const {
  const Index most = options_.max_influences;
  if (is_within(most, projected)) return projected;
  const auto support = by_size(projected);
  const Vector<Dim> target = target_of(point, projected);
  work.selection.qp().aim_at(target) = given;
  Eigen::VectorXd weights;
  if (reduce(most, given, projected, support, work) &&
      projection_.project(target, work.best.support, to_dense(work.best, given.size()), weights)) {
    return weights;
  }
  return on_few_points(target, given, support, most);
}

template <int Dim>
Eigen::VectorXd PointSparsifier<Dim>::with_one_more(const Vector<Dim>& point,
                                                    const Eigen::VectorXd& given,
                                                    const Eigen::VectorXd& projected,
                                                    Workspace& work) const {
  const auto support = by_size(projected);
  const Index more = std::min(options_.max_influences, count(support)) + 1;
  if (is_within(more, projected)) return projected;
  const Vector<Dim> target = target_of(point, projected);
  work.selection.qp().aim_at(target) = given;
  if (reduce(more, given, projected, support, work)) return to_dense(work.best, given.size());
  return on_few_points(target, given, support, more);
}

template <int Dim>
bool PointSparsifier<Dim>::is_within(Index most, const Eigen::VectorXd& projected) const {
  Index influences = 0;
  for (const double weight : projected) {
    if (!(weight > 0)) continue;
    if (weight < options_.threshold || ++influences > most) return false;
  }
  return true;
}

// A point outside the hull within the tolerance counts as the nearest point of the hull.
template <int Dim>
Vector<Dim> PointSparsifier<Dim>::target_of(const Vector<Dim>& point,
                                            const Eigen::VectorXd& projected) const {
  if (projection_.is_feasible(point, projected)) return point;
  return nearest_point_in_hull(control_points_, point).point;
}

// \param support  by size \return whether work.best has weights on at most so many control points
template <int Dim>
bool PointSparsifier<Dim>::reduce(Index most, const Eigen::VectorXd& given,
                                  const Eigen::VectorXd& projected,
                                  const std::vector<Index>& support, Workspace& work) const {
  std::size_t keep = 0;
  while (keep < support.size() && projected[support[keep]] >= options_.threshold) ++keep;
  if (!start(support, keep, work)) return false;
  if (!work.selection.reduce(most, kNoBound, work.reduced)) return false;
  exchange(given, support, most, work);
  return true;
}

// Weights to be reduced, of the largest influences.
// \param support  by size \param keep  number of influences above the threshold
template <int Dim>
bool PointSparsifier<Dim>::start(const std::vector<Index>& support, std::size_t keep,
                                 Workspace& work) const {
  const auto largest = [&](std::size_t number) {
    std::vector<Index> some(support.begin(), support.begin() + number);
    std::sort(some.begin(), some.end());
    return some;
  };
  // Many small weights rarely matter, and removing them one by one would be slow.
  constexpr std::size_t kPool = 16;
  const Index most = options_.max_influences;
  std::size_t number = std::max<std::size_t>(keep, 1);
  if (count(support) > most) {
    number = std::min(number, std::max(kPool, 2 * static_cast<std::size_t>(most)));
  }
  // Until the point is in the hull of the kept control points.
  while (!work.selection.qp().solve(largest(number), kNoBound, work.reduced)) {
    if (number == support.size()) return false;
    number = std::min(support.size(), number + 1 + number / 8);
  }
  return true;
}

template <int Dim>
void PointSparsifier<Dim>::exchange(const Eigen::VectorXd& given, const std::vector<Index>& support,
                                    Index most, Workspace& work) const {
  work.best = work.reduced;
  // With a threshold, the exchange would reinsert dropped influences.
  if (count(support) <= most || options_.threshold > 0) return;
  work.may_enter.clear();
  for (Index i = 0; i < static_cast<Index>(given.size()); ++i) {
    if (given[i] >= kLeastInfluence) work.may_enter.push_back(i);
  }
  work.selection.exchange(most, kLeastGain, work.may_enter, work.best);
}

// If rounding hides the best choice, uses the few control points of Caratheodory's theorem, which
// are always feasible, plus the largest others.
template <int Dim>
Eigen::VectorXd PointSparsifier<Dim>::on_few_points(const Vector<Dim>& target,
                                                    const Eigen::VectorXd& given,
                                                    const std::vector<Index>& support,
                                                    Index most) const {
  const PointList<Dim> carriers = control_points_(Eigen::all, support);
  const auto nearest = nearest_point_in_hull<Dim>(carriers, target);
  std::vector<Index> chosen;
  Eigen::VectorXd weights = Eigen::VectorXd::Zero(given.size());
  for (int k = 0; k < nearest.size; ++k) {
    chosen.push_back(support[nearest.support[k]]);
    weights[chosen.back()] = nearest.weights[k];
  }
  for (const Index i : support) {
    if (count(chosen) >= most) break;
    if (std::find(chosen.begin(), chosen.end(), i) == chosen.end()) chosen.push_back(i);
  }
  Eigen::VectorXd nearer;
  return projection_.project(target, chosen, given, nearer) ? nearer : weights;
}

template class PointSparsifier<2>;
template class PointSparsifier<3>;

}  // namespace flbc

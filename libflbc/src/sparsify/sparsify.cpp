// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/sparsify.h"

#include <omp.h>

#include <algorithm>
#include <limits>
#include <optional>
#include <string>

#include "base/instantiate.h"
#include "base/messages.h"
#include "base/stage_progress.h"
#include "flbc/errors.h"
#include "flbc/non_negative.h"
#include "polytope/nearest_point_in_hull.h"
#include "polytope/scaling.h"
#include "polytope/weight_projection.h"
#include "sparsify/sparsify_twice.h"
#include "sparsify/support_selection.h"

namespace flbc {
namespace {

// Minimum decrease of |w - given|^2 by an exchange, above rounding errors.
constexpr double kLeastGain = 1e-9;
constexpr double kNoBound = std::numeric_limits<double>::infinity();

// Reduces the influences of one point. Thread-safe.
template <int Dim>
class PointSparsifier {
 public:
  // The support search, one per thread.
  struct Workspace {
    explicit Workspace(const PointList<Dim>& control_points)
        : selection(Metric(), control_points), may_enter(control_points.cols()) {}
    SupportSelection<Dim> selection;
    std::vector<bool> may_enter;
    PointWeights reduced, best;
  };

  PointSparsifier(const PointList<Dim>& control_points, const SparsifyOptions& options)
      : control_points_(control_points), options_(options), projection_(control_points) {}

  // \param given  the given weights \param projected  the nearest feasible weights
  // \param one_more  unless null, receives weights with one more influence than allowed,
  // accurate to about 1e-8
  Eigen::VectorXd sparsify(const Vector<Dim>& point, const Eigen::VectorXd& given,
                           const Eigen::VectorXd& projected, Workspace& work,
                           Eigen::VectorXd* one_more) const {
    const auto support = by_size(projected);
    const auto keep = above_threshold(projected, support);
    const auto is_within = [&](Index most) {
      return keep == support.size() && count(support) <= most;
    };
    if (one_more) *one_more = projected;
    const Index most = options_.max_influences;
    if (is_within(most)) return projected;

    const Vector<Dim> target = target_of(point, projected);
    work.selection.qp().aim_at(target) = given;
    bool is_reduced = start(support, keep, work);
    const auto reduce = [&](Index limit) -> Eigen::VectorXd {
      is_reduced = is_reduced && work.selection.reduce(limit, kNoBound, work.reduced);
      Eigen::VectorXd weights;
      if (is_reduced) {
        exchange(given, support, limit, work);
        if (limit > most) return dense(work.best, given.size());
        if (projection_.project(target, work.best.support, given, weights)) return weights;
      }
      return on_few_points(target, given, support, limit);
    };
    // Those with one more influence are on the way to the others.
    const Index more = std::min(most, count(support)) + 1;
    if (one_more && !is_within(more)) *one_more = reduce(more);
    return reduce(most);
  }

 private:
  static Index count(const std::vector<Index>& support) {
    return static_cast<Index>(support.size());
  }

  // Accurate to about 1e-8.
  static Eigen::VectorXd dense(const PointWeights& few, Eigen::Index size) {
    Eigen::VectorXd weights = Eigen::VectorXd::Zero(size);
    for (std::size_t k = 0; k < few.support.size(); ++k) weights[few.support[k]] = few.values[k];
    return weights;
  }

  // The influences, largest first.
  static std::vector<Index> by_size(const Eigen::VectorXd& weights) {
    auto support = positive_entries(weights);
    std::stable_sort(support.begin(), support.end(),
                     [&](Index a, Index b) { return weights[a] > weights[b]; });
    return support;
  }

  std::size_t above_threshold(const Eigen::VectorXd& weights,
                              const std::vector<Index>& support) const {
    std::size_t keep = 0;
    while (keep < support.size() && weights[support[keep]] >= options_.threshold) ++keep;
    return keep;
  }

  // A point outside the hull within the tolerance counts as the nearest point of the hull.
  Vector<Dim> target_of(const Vector<Dim>& point, const Eigen::VectorXd& projected) const {
    if (projection_.is_feasible(point, projected)) return point;
    return nearest_point_in_hull(control_points_, point).point;
  }

  // Weights to be reduced, of the largest influences.
  // \param support  by size \param keep  number of influences above the threshold
  bool start(const std::vector<Index>& support, std::size_t keep, Workspace& work) const {
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

  void exchange(const Eigen::VectorXd& given, const std::vector<Index>& support, Index most,
                Workspace& work) const {
    work.best = work.reduced;
    // With a threshold, the exchange would reinsert dropped influences.
    if (count(support) <= most || options_.threshold > 0) return;
    for (Eigen::Index i = 0; i < given.size(); ++i) work.may_enter[i] = given[i] >= kLeastInfluence;
    work.selection.exchange(most, kLeastGain, work.may_enter, work.best);
  }

  // If rounding hides the best choice, uses the few control points of Caratheodory's theorem, which
  // are always feasible, plus the largest others.
  Eigen::VectorXd on_few_points(const Vector<Dim>& target, const Eigen::VectorXd& given,
                                const std::vector<Index>& support, Index most) const {
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

  const PointList<Dim>& control_points_;
  SparsifyOptions options_;
  WeightProjection<Dim> projection_;
};

// Within reduce_by_poisson(), its callback receives the progress.
StageCallback callback_of(const SparsifyOptions& options) {
  if (options.progress || !StageScope::present()) return options.progress;
  return *StageScope::present();
}

// \param one_more  as for a point
template <int Dim>
SparseWeights sparsify_points(const PointList<Dim>& control_points, const PointList<Dim>& points,
                              const SparseWeights& weights, const SparsifyOptions& options,
                              WeightMatrix* one_more) {
  validate<Dim>(options);
  const StageScope scope(callback_of(options));
  const auto projected = [&] {
    const StageScope silent({});
    return project_non_negative(control_points, points, weights);  // also checks the input
  }();
  const auto num_points = static_cast<Index>(points.cols());
  if (one_more) one_more->resize(control_points.cols(), num_points);
  const PointSparsifier<Dim> sparsifier(control_points, options);
  LoopProgress progress(num_points);
  std::vector<std::optional<typename PointSparsifier<Dim>::Workspace>> works(omp_get_max_threads());
  return SparseWeights::of(static_cast<Index>(control_points.cols()), num_points, [&](Index p) {
    auto& work = works[omp_get_thread_num()];
    if (!work) work.emplace(control_points);
    progress.add(1);
    Eigen::VectorXd more;
    auto few = sparsifier.sparsify(points.col(p), weights.at(p), projected.at(p), *work,
                                   one_more ? &more : nullptr);
    if (one_more) one_more->col(p) = more;
    return few;
  });
}

}  // namespace

template <int Dim>
void validate(const SparsifyOptions& options) {
  if (options.max_influences < Dim + 1) {
    throw OptionError("at most " + std::to_string(options.max_influences) +
                      " influences per vertex are too few; in " + std::to_string(Dim) +
                      "D, at least " + std::to_string(Dim + 1) + " are needed to reproduce it");
  }
  if (!(options.threshold >= 0 && options.threshold < 1)) {
    throw OptionError("the threshold must be at least 0 and below 1, not " +
                      format_number(options.threshold));
  }
}

template <int Dim>
SparseWeights sparsify(const PointList<Dim>& control_points, const PointList<Dim>& points,
                       const SparseWeights& weights, const SparsifyOptions& options) {
  return sparsify_points(control_points, points, weights, options, nullptr);
}

template <int Dim>
SparseWeights sparsify_twice(const PointList<Dim>& control_points, const PointList<Dim>& points,
                             const SparseWeights& weights, const SparsifyOptions& options,
                             WeightMatrix& one_more) {
  return sparsify_points(control_points, points, weights, options, &one_more);
}

template void validate<2>(const SparsifyOptions&);
template void validate<3>(const SparsifyOptions&);
FLBC_INSTANTIATE_FUNCTION(sparsify)
FLBC_INSTANTIATE_FUNCTION(sparsify_twice)

}  // namespace flbc

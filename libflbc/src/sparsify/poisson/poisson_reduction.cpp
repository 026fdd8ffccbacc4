// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/sparsify.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <vector>

#include "base/instantiate.h"
#include "base/parallel.h"
#include "base/shape_checks.h"
#include "base/stage_progress.h"
#include "flbc/non_negative.h"
#include "flbc/types.h"
#include "polytope/scaling.h"
#include "sparsify/point_sparsifier.h"
#include "sparsify/poisson/edge_graph.h"
#include "sparsify/poisson/poisson_energy.h"

namespace flbc {
namespace {

// Over-relaxation factor of the steps. Below 2, the energy never increases.
constexpr double kOvershoot = 1.5;
// Number of neighbor supports that are tried at a point.
constexpr std::size_t kSupports = 16;
// Invisible gains in squared distance, in units of a tenth of cage size.
constexpr double kInvisible = 1e-11;
// Minimum gain of a change of one point, relative to the mean energy of a point.
constexpr double kLeastGain = 1e-2;

void gather(const Eigen::Ref<const Eigen::VectorXd>& column, PointWeights& weights) {
  weights.support = positive_entries(column);
  weights.values.clear();
  for (const Index i : weights.support) weights.values.push_back(column[i]);
}

// Over-relaxes if no control point was removed, but at most half the way to zero, so that none is
// removed here.
void overshoot(const PointWeights& before, PointWeights& after) {
  if (!std::includes(after.support.begin(), after.support.end(), before.support.begin(),
                     before.support.end())) {
    return;
  }
  std::vector<double> from(after.support.size(), 0);
  for (std::size_t k = 0, l = 0; l < before.support.size(); ++k) {
    if (after.support[k] == before.support[l]) from[k] = before.values[l++];
  }
  double factor = kOvershoot;
  for (std::size_t k = 0; k < from.size(); ++k) {
    const double loss = from[k] - after.values[k];
    if (loss > 0) factor = std::min(factor, 1 + after.values[k] / (2 * loss));
  }
  for (std::size_t k = 0; k < from.size(); ++k) {
    after.values[k] = from[k] + factor * (after.values[k] - from[k]);
  }
}

// Decreases the energy by changing the sparse weights of one point at a time. Points merged in the
// graph count as one.
template <int Dim>
class PoissonDescent {
 public:
  // Everything is kept by reference, except the options.
  // \param control_points  Dim x n
  // \param points  Dim x P
  // \param given  of P points, target weights
  // \param projected  of P points, the nearest feasible weights
  PoissonDescent(const PoissonEnergy& energy, const EdgeGraph& graph,
                 const PointList<Dim>& control_points, const PointList<Dim>& points,
                 const SparseWeights& given, const SparseWeights& projected,
                 const SparsifyOptions& options)
      : energy_(energy),
        graph_(graph),
        control_points_(control_points),
        points_(points),
        given_(given),
        projected_(projected),
        options_(options),
        sparsifier_(control_points, options),
        stiffness_(points.cols()),
        fixed_(points.cols()),
        weights_(points.cols()),
        potential_(control_points.cols(), points.cols()),
        open_(points.cols()) {
    for (Index a = 0; a < static_cast<Index>(points.cols()); ++a) {
      stiffness_[a] = energy.pin * graph.mass(a);
      for (const auto& neighbour : graph_.neighbours_of(a)) stiffness_[a] += neighbour.weight;
    }
  }

  // Starts with one influence more than allowed, which lets neighbors agree on which one to drop:
  // the first visit of a point removes the excess.
  void start() {
    const auto num_points = static_cast<Index>(points_.cols());
    LoopProgress progress(num_points);
    const auto make_work = [&] {
      return typename PointSparsifier<Dim>::Workspace(control_points_);
    };
    parallel_for_chunks(num_points, 64, make_work, [&](Index a, auto& work) {
      progress.add(1);
      const Eigen::VectorXd given = given_.at(a), projected = projected_.at(a);
      // On the cage, weights are those of the facet.
      fixed_[a] = given == projected && (given.array() != 0).count() <= Dim;
      const auto more = sparsifier_.with_one_more(points_.col(a), given, projected, work);
      gather(more, weights_[a]);
      potential_.col(a).setZero();
      const Eigen::VectorXd difference = more - given;
      for (Eigen::Index i = 0; i < difference.size(); ++i) {
        if (difference[i] != 0) potential_.col(a) += difference[i] * energy_.metric.col(i);
      }
    });
    // If all differences are 0 there is nothing to gain, but influences may have to be removed.
    std::fill(open_.begin(), open_.end(), false);
    for (Index a = 0; a < num_points; ++a) {
      if (static_cast<Index>(weights_[a].support.size()) > options_.max_influences) open_[a] = true;
      if (potential_.col(a).isZero(0)) continue;
      open_[a] = true;
      for (const auto& neighbour : graph_.neighbours_of(a)) open_[neighbour.point] = true;
    }
  }

  // Adopting the supports of neighbors gives most of the gain and costs little, so exchanges with
  // other control points come last.
  void run() {
    constexpr int kAdoptions = 12, kExchanges = 4;
    constexpr double kAdopted = 0.6;  // share of the time
    {
      const StagePart part(0, kAdopted);
      sweep_until_settled(kAdoptions);
    }
    const StagePart part(kAdopted, 1);
    exchanges_ = true;
    std::fill(open_.begin(), open_.end(), true);
    sweep_until_settled(kExchanges);
  }

  // The weights of a point with exact sum and reproduction. Points without edges, or where
  // rounding prevents this, get those of sparsify(). Thread-safe.
  Eigen::VectorXd weights_of(Index point) const {
    const Index representative = graph_.representative(point);
    Eigen::VectorXd projected = projected_.at(point), exact;
    if (has_neighbours(representative)) {
      const auto weights = to_dense(weights_[representative], control_points_.cols());
      if (weights == projected) return projected;
      if (sparsifier_.projection().project(points_.col(point), weights_[representative].support,
                                           weights, exact)) {
        return exact;
      }
    }
    return alone(point, projected);
  }

 private:
  bool has_neighbours(Index point) const {
    const auto neighbours = graph_.neighbours_of(point);
    return neighbours.begin() != neighbours.end();
  }

  // The weights that sparsify() gives a point.
  Eigen::VectorXd alone(Index point, const Eigen::VectorXd& projected) const {
    typename PointSparsifier<Dim>::Workspace work(control_points_);
    return sparsifier_.sparsify(points_.col(point), given_.at(point), projected, work);
  }

  // The energy of the weights, d . (s P - sum k P_b) summed over the points, where P = H d.
  double energy() const {
    const auto force = [&](Index a, Index i) {
      double sum = stiffness_[a] * potential_(i, a);
      for (const auto& [b, weight] : graph_.neighbours_of(a)) sum -= weight * potential_(i, b);
      return sum;
    };
    return parallel_sum<double>(static_cast<Index>(points_.cols()), 0, [&](Index begin, Index end) {
      double sum = 0;
      for (Index a = begin; a < end; ++a) {
        if (!has_neighbours(a)) continue;
        given_.visit(a, [&](Index i, double weight) { sum -= weight * force(a, i); });
        const auto& [support, values, cost] = weights_[a];
        for (std::size_t k = 0; k < support.size(); ++k) sum += values[k] * force(a, support[k]);
      }
      return sum;
    });
  }

  // Sweeps over the points until no point gains more than the least gain, at most `sweeps` times.
  void sweep_until_settled(int sweeps) {
    // Each sweep leaves about this fraction of work to the next.
    constexpr double kFall = 0.6;
    for (int k = 0; k < sweeps; ++k) {
      const StagePart part(1 - std::pow(kFall, k), 1 - std::pow(kFall, k + 1));
      if (!sweep()) return;
      // The first two sweeps bring the energy near its end.
      if (k == 1 && !exchanges_)
        least_gain_ = kLeastGain * energy() / static_cast<double>(points_.cols());
    }
  }

  struct Workspace {
    Workspace(const Eigen::MatrixXd& metric, const PointList<Dim>& control_points)
        : selection(Metric(metric), control_points) {}
    SupportSelection<Dim> selection;
    PointWeights best;
    std::vector<bool> may_enter;
    std::vector<const std::vector<Index>*> supports;
  };

  // Processes color by color. Points of one color are independent, so order and threads have no
  // effect.
  bool sweep() {
    std::atomic<bool> changes{false};
    LoopProgress progress(static_cast<Index>(points_.cols()));
    const auto make_work = [&] { return Workspace(energy_.metric, control_points_); };
    for (const auto& color : graph_.colors()) {
      const auto visit = [&](Index k, Workspace& work) {
        const Index point = color[k];
        progress.add(1);
        if (!open_[point] || fixed_[point]) return;
        open_[point] = false;
        if (!improve(point, work)) return;
        changes = true;
        for (const auto& neighbour : graph_.neighbours_of(point)) open_[neighbour.point] = true;
      };
      parallel_for_chunks(static_cast<Index>(color.size()), 16, make_work, visit);
    }
    return changes;
  }

  // \return whether the weights have changed
  bool improve(Index point, Workspace& work) {
    const double least = std::max(kInvisible, least_gain_ / stiffness_[point]);
    const Index most = options_.max_influences;
    aim(point, work);
    const PointWeights& before = weights_[point];
    const bool too_many = static_cast<Index>(before.support.size()) > most;
    const double cost = work.selection.qp().cost_of(before);
    PointWeights& best = work.best;
    best = before;
    work.selection.qp().descend(best);
    if (!work.selection.reduce(most, std::numeric_limits<double>::infinity(), best)) {
      gather(alone(point, projected_.at(point)), best);
      best.cost = work.selection.qp().cost_of(best);
    }
    if (exchanges_ || options_.threshold > 0) find_allowed(point, work.may_enter);
    find_supports_around(point, work);
    for (const auto* support : work.supports) work.selection.adopt(*support, least, best);
    if (exchanges_) work.selection.exchange(most, least, work.may_enter, best);
    if (!too_many) {
      if (!(best.cost < cost - least)) return false;
      overshoot(before, best);
    }
    update(point, best);
    return true;
  }

  // For fixed neighbors b, the energy is s (w - t) . H (w - t) and a constant, with the stiffness s
  // = pin m_a + sum_b k_ab and t = given + sum_b k_ab d_b / s.
  void aim(Index point, Workspace& work) const {
    Eigen::VectorXd& pull = work.selection.qp().aim_at(points_.col(point));
    pull = -potential_.col(point);
    const PointWeights& weights = weights_[point];
    for (std::size_t k = 0; k < weights.support.size(); ++k) {
      pull += weights.values[k] * energy_.metric.col(weights.support[k]);
    }
    for (const auto& [neighbour, weight] : graph_.neighbours_of(point)) {
      pull += weight / stiffness_[point] * potential_.col(neighbour);
    }
  }

  void find_allowed(Index point, std::vector<bool>& may_enter) const {
    const double least = std::max(options_.threshold, kLeastInfluence);
    may_enter.assign(control_points_.cols(), false);
    given_.visit(point, [&](Index i, double weight) { may_enter[i] = weight >= least; });
    for (const Index i : weights_[point].support) may_enter[i] = true;
  }

  // The support of a neighbor often works here too, and then there is no seam between them.
  void find_supports_around(Index point, Workspace& work) const {
    auto& supports = work.supports;
    supports.clear();
    for (const auto& neighbour : graph_.neighbours_of(point)) {
      if (supports.size() == kSupports) return;
      const auto& support = weights_[neighbour.point].support;
      // A point without weights does not move; see project_non_negative().
      if (support.empty() || static_cast<Index>(support.size()) > options_.max_influences) continue;
      const auto may_enter = [&](Index i) { return work.may_enter[i]; };
      if (options_.threshold > 0 && !std::all_of(support.begin(), support.end(), may_enter))
        continue;
      const auto is_same = [&](const std::vector<Index>* other) { return *other == support; };
      if (std::none_of(supports.begin(), supports.end(), is_same)) supports.push_back(&support);
    }
  }

  void update(Index point, const PointWeights& weights) {
    const auto add = [&](const PointWeights& any, double sign) {
      for (std::size_t k = 0; k < any.support.size(); ++k) {
        potential_.col(point) += sign * any.values[k] * energy_.metric.col(any.support[k]);
      }
    };
    add(weights_[point], -1);
    add(weights, 1);
    weights_[point] = weights;
  }

  const PoissonEnergy& energy_;
  const EdgeGraph& graph_;
  const PointList<Dim>& control_points_;
  const PointList<Dim>& points_;
  const SparseWeights& given_;
  const SparseWeights& projected_;
  SparsifyOptions options_;
  PointSparsifier<Dim> sparsifier_;
  std::vector<double> stiffness_;  // per point: the sum of k_ab and pin m_a
  std::vector<char> fixed_;
  std::vector<PointWeights> weights_;
  Eigen::MatrixXd potential_;            // n x P: H (w - given)
  std::vector<std::atomic<bool>> open_;  // per point: whether it may gain
  double least_gain_ = 0;                // of a change of one point
  bool exchanges_ = false;               // whether influences may enter that no neighbor has
};

}  // namespace

template <int Dim>
SparseWeights reduce_by_poisson(const PointList<Dim>& control_points, const PointList<Dim>& points,
                                const EdgeList& edges, const SparseWeights& given,
                                const std::vector<PointList<Dim>>& poses,
                                const SparsifyOptions& options) {
  validate(edges, points.cols());
  validate<Dim>(options);
  const StageScope scope(options.progress);
  constexpr double kStart = 0.3;  // share of the time
  const auto projected = [&] {
    const StagePart part(0, kStart / 2);
    return project_non_negative(control_points, points, given);  // checks the input
  }();
  const auto energy = make_poisson_energy<Dim>(control_points, points, edges, poses);
  const EdgeGraph graph(points, given, edges);
  PoissonDescent<Dim> descent(energy, graph, control_points, points, given, projected, options);
  {
    const StagePart part(kStart / 2, kStart);
    descent.start();
  }
  const StagePart part(kStart, 1);
  descent.run();
  return SparseWeights::of(given.num_control_points(), given.num_points(),
                           [&](Index a) { return descent.weights_of(a); });
}

bool suits_poisson(const EdgeList& edges, Eigen::Index num_control_points,
                   Eigen::Index num_points) {
  constexpr double kMostNumbers = 2.5e8;
  const double numbers = static_cast<double>(num_control_points) * static_cast<double>(num_points);
  return !edges.ends.empty() && numbers <= kMostNumbers;
}

template <int Dim>
SparseWeights reduce_influences(const PointList<Dim>& control_points, const PointList<Dim>& points,
                                const EdgeList& edges, const SparseWeights& weights,
                                const std::vector<PointList<Dim>>& poses,
                                const SparsifyOptions& options) {
  const auto& starts = weights.starts();
  bool has_few = options.threshold == 0;
  for (std::size_t p = 1; p < starts.size(); ++p) {
    has_few = has_few && starts[p] - starts[p - 1] <= options.max_influences;
  }
  if (has_few || !suits_poisson(edges, control_points.cols(), points.cols())) {
    return sparsify(control_points, points, weights, options);
  }
  return reduce_by_poisson(control_points, points, edges, weights, poses, options);
}

template <int Dim>
double poisson_cost(const PointList<Dim>& control_points, const PointList<Dim>& points,
                    const EdgeList& edges, const SparseWeights& before, const SparseWeights& after,
                    const std::vector<PointList<Dim>>& poses) {
  check_size(before, control_points.cols(), points.cols());
  check_size(after, control_points.cols(), points.cols());
  validate(edges, points.cols());
  return evaluate<Dim>(make_poisson_energy<Dim>(control_points, points, edges, poses), points,
                       edges, before.dense(), after.dense());
}

FLBC_INSTANTIATE_FUNCTION(reduce_by_poisson)
FLBC_INSTANTIATE_FUNCTION(reduce_influences)
FLBC_INSTANTIATE_FUNCTION(poisson_cost)

}  // namespace flbc

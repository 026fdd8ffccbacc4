// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/sparsify.h"

#include <algorithm>
#include <atomic>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "base/instantiate.h"
#include "base/parallel.h"
#include "base/shape_checks.h"
#include "base/stage_progress.h"
#include "base/take_points.h"
#include "flbc/non_negative.h"
#include "flbc/types.h"
#include "polytope/scaling.h"
#include "sparsify/point_sparsifier.h"
#include "sparsify/poisson/edge_graph.h"
#include "sparsify/poisson/poisson_energy.h"

namespace flbc {
namespace {

// Over-relaxation factor of the steps. Below 2, the energy never increases.
constexpr double kOvershoot = 1.7;
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

// Reverse to a breadth-first search (reverse Cuthill-McKee), so that neighbors get close numbers
// and share cache lines. Without regard to places: a moved model has the same results.
std::vector<Index> breadth_first_order(Index num_points, const EdgeList& edges) {
  const auto around = items_by_vertex<Index>(num_points, [&](const auto& visit) {
    for (const auto& [a, b] : edges.ends) {
      visit(a, b);
      visit(b, a);
    }
  });
  std::vector<Index> order;
  std::vector<char> is_found(num_points, false);
  const auto find = [&](Index point) {
    if (!is_found[point]) order.push_back(point);
    is_found[point] = true;
  };
  std::size_t next = 0;
  for (Index seed = 0; seed < num_points; ++seed) {
    find(seed);
    for (; next < order.size(); ++next) {
      for (const Index neighbour : around.of(order[next])) find(neighbour);
    }
  }
  std::reverse(order.begin(), order.end());
  return order;
}

template <class Numbers>
void renumber(Numbers& points, const std::vector<Index>& number_of) {
  for (auto& point : points) point = number_of[point];
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

// Decreases the energy by changing the sparse weights of one point at a time.
template <int Dim>
class PoissonDescent {
 public:
  // Everything is kept by reference, except the options.
  // \param control_points  Dim x n
  // \param points  Dim x P
  // \param given  of P points, target weights
  // \param projected  of P points, the nearest feasible weights
  // \param start  of P points, or empty
  PoissonDescent(const PoissonEnergy& energy, const EdgeGraph& graph,
                 const PointList<Dim>& control_points, const PointList<Dim>& points,
                 const SparseWeights& given, const SparseWeights& projected,
                 const SparseWeights& start, const SparsifyOptions& options,
                 const PointMasks& masks)
      : energy_(energy),
        graph_(graph),
        control_points_(control_points),
        points_(points),
        given_(given),
        projected_(projected),
        given_start_(start),
        options_(options),
        masks_(masks),
        sparsifier_(control_points, options),
        stiffness_(points.cols()),
        fixed_(points.cols()),
        weights_(points.cols()),
        moments_(energy.metric.factor.rows(), points.cols()),
        open_(points.cols()),
        workspaces_(omp_get_max_threads()) {
    const auto num_points = static_cast<Index>(points.cols());
    for (Index a = 0; a < num_points; ++a) {
      stiffness_[a] = energy.pin * graph.mass(a);
      for (const auto& neighbour : graph_.neighbours_of(a)) stiffness_[a] += neighbour.weight;
    }
    rest_ = SparseWeights::of(given.num_control_points(), num_points, [&](Index a) {
      Eigen::VectorXd rest = given.at(a);
      for (const auto& [b, weight] : graph_.neighbours_of(a)) {
        const double share = weight / stiffness_[a];
        given_.visit(b, [&](Index i, double value) { rest[i] -= share * value; });
      }
      return rest;
    });
    rest_moments_.resize(moments_.rows(), moments_.cols());
    parallel_for(num_points, [&](Index a) {
      rest_moments_.col(a).setZero();
      rest_.visit(a, [&](Index i, double value) {
        rest_moments_.col(a) += value * energy_.metric.factor.col(i);
      });
    });
  }

  // Starts with one influence more than allowed, which lets neighbors agree on which one to drop:
  // the first visit of a point removes the excess. Points that are not neighbors choose their
  // influences, and the others get those of a neighbor.
  void start() {
    const auto num_points = static_cast<Index>(points_.cols());
    // In the order of the points, because neighbors are read together.
    for (Index a = 0; a < num_points; ++a) {
      const Index most = std::min(options_.max_influences, projected_.count(a)) + 1;
      weights_[a].support.reserve(most);
      weights_[a].values.reserve(most);
    }
    LoopProgress progress(num_points);
    const auto make_work = [&] {
      return typename PointSparsifier<Dim>::Workspace(control_points_);
    };
    std::vector<Start> starts(num_points, Start::kNone);
    std::vector<char> changed(num_points);
    const auto begin = [&](Index point, auto& work) {
      progress.add(1);
      const auto neighbours = graph_.neighbours_of(point);
      const bool chooses = std::none_of(neighbours.begin(), neighbours.end(), [&](const auto& one) {
        return starts[one.point] == Start::kChosen;
      });
      const bool is_taken =
          start_as_before(point, work) || (!chooses && start_like_neighbor(point, starts, work));
      starts[point] = is_taken ? Start::kTaken : Start::kChosen;
      changed[point] = is_taken || start_alone(point, work);
      moments_.col(point) = moments_of(weights_[point]);
    };
    for (const auto& blocks : graph_.colors()) {
      parallel_for_chunks(static_cast<Index>(blocks.size()), 1, make_work,
                          [&](Index b, auto& work) {
                            for (const Index point : blocks[b]) begin(point, work);
                          });
    }
    // If all differences are 0 there is nothing to gain, but influences may have to be removed.
    std::fill(open_.begin(), open_.end(), false);
    for (Index a = 0; a < num_points; ++a) {
      if (static_cast<Index>(weights_[a].support.size()) > options_.max_influences) open_[a] = true;
      if (!changed[a]) continue;
      open_[a] = true;
      for (const auto& neighbour : graph_.neighbours_of(a)) open_[neighbour.point] = true;
    }
  }

  // Adopting the supports of neighbors gives most of the gain and costs little, so exchanges with
  // other control points come last. On a horse of 48,485 vertices, edges keep an error of 1.02%
  // in smooth poses.
  void run() {
    constexpr double kAdopted = 0.7;  // share of the time
    {
      const StagePart part(0, kAdopted);
      sweep_until_settled(5);
    }
    const StagePart part(kAdopted, 1);
    exchanges_ = true;
    std::fill(open_.begin(), open_.end(), true);
    sweep_until_settled(3);
  }

  // The weights of a point with exact sum and reproduction. Points without edges, or where
  // rounding prevents this, get those of sparsify(). Thread-safe.
  Eigen::VectorXd weights_of(Index point) const {
    Eigen::VectorXd projected = projected_.at(point), exact;
    if (has_neighbours(point)) {
      const auto weights = to_dense(weights_[point], control_points_.cols());
      if (weights == projected) return projected;
      if (sparsifier_.projection().project(points_.col(point), weights_[point].support, weights,
                                           exact)) {
        return exact;
      }
    }
    return alone(point, projected);
  }

 private:
  enum class Start : char { kNone, kTaken, kChosen };  // influences of a neighbor, or its own

  struct Workspace {
    Workspace(const Eigen::MatrixXd& metric, const PointList<Dim>& control_points)
        : selection(Metric(metric), control_points),
          target(Eigen::VectorXd::Zero(control_points.cols())) {}
    SupportSelection<Dim> selection;
    PointWeights best;
    std::vector<Index> may_enter;
    std::vector<const std::vector<Index>*> supports;
    Eigen::VectorXd target;          // t, n; zero between visits
    Eigen::VectorXd target_moments;  // F t
  };

  bool has_neighbours(Index point) const {
    const auto neighbours = graph_.neighbours_of(point);
    return neighbours.begin() != neighbours.end();
  }

  // \return whether the weights are not those given
  bool start_alone(Index point, typename PointSparsifier<Dim>::Workspace& work) {
    const Eigen::VectorXd given = given_.at(point), projected = projected_.at(point);
    // On the cage, weights are those of the facet.
    fixed_[point] = given == projected && (given.array() != 0).count() <= Dim;
    const auto more = sparsifier_.with_one_more(points_.col(point), given, projected, work);
    gather(more, weights_[point]);
    return more != given;
  }

  bool needs_few(Index point) const {
    return options_.threshold == 0 && projected_.count(point) > options_.max_influences;
  }

  // Takes the influences of an earlier reduction to the same number.
  // \return false if there are none, or no need
  bool start_as_before(Index point, typename PointSparsifier<Dim>::Workspace& work) {
    if (given_start_.num_points() == 0 || !needs_few(point)) return false;
    const auto support = positive_entries(given_start_.at(point));
    if (static_cast<Index>(support.size()) != options_.max_influences) return false;
    if (!masks_.permits(point, support)) return false;
    auto& qp = work.selection.qp();
    qp.aim_at(points_.col(point)) = given_.at(point);
    return qp.solve(support, std::numeric_limits<double>::infinity(), weights_[point]);
  }

  // Takes the best support of the neighbors that have started, as with_one_more() would choose one.
  // \return false if there is none, or no need
  bool start_like_neighbor(Index point, const std::vector<Start>& starts,
                           typename PointSparsifier<Dim>::Workspace& work) {
    if (!needs_few(point)) return false;
    auto& qp = work.selection.qp();
    qp.aim_at(points_.col(point)) = given_.at(point);
    PointWeights& best = weights_[point];
    best.cost = std::numeric_limits<double>::infinity();
    for (const auto& neighbour : graph_.neighbours_of(point)) {
      if (starts[neighbour.point] == Start::kNone) continue;
      const auto& support = weights_[neighbour.point].support;
      if (!masks_.permits(point, support)) continue;
      if (support == best.support || !qp.solve(support, best.cost, work.best)) continue;
      if (work.best.cost < best.cost) best = work.best;
    }
    return !best.support.empty();
  }

  // The weights that sparsify() gives a point.
  Eigen::VectorXd alone(Index point, const Eigen::VectorXd& projected) const {
    typename PointSparsifier<Dim>::Workspace work(control_points_);
    return sparsifier_.sparsify(points_.col(point), given_.at(point), projected, work);
  }

  // The energy of the weights, s d . H (w - t) summed over the points.
  double energy() const {
    return parallel_sum<double>(static_cast<Index>(points_.cols()), 0, [&](Index begin, Index end) {
      Workspace& work = *workspace();
      double sum = 0;
      for (Index a = begin; a < end; ++a) {
        if (!has_neighbours(a)) continue;
        find_target(a, work);
        const auto& [support, values, cost] = weights_[a];
        for (std::size_t k = 0; k < support.size(); ++k) work.target[support[k]] -= values[k];
        work.target_moments -= moments_.col(a);
        const auto force = [&](Index i) { return -stiffness_[a] * pull(i, work); };
        given_.visit(a, [&](Index i, double weight) { sum -= weight * force(i); });
        for (std::size_t k = 0; k < support.size(); ++k) sum += values[k] * force(support[k]);
        clear_target(a, work);
        for (const Index i : support) work.target[i] = 0;
      }
      return sum;
    });
  }

  // Sweeps over the points until no point gains more than the least gain.
  void sweep_until_settled(int most_sweeps) {
    for (int k = 0; k < most_sweeps; ++k) {
      const StagePart part(static_cast<double>(k) / most_sweeps, (k + 1.0) / most_sweeps);
      if (!sweep()) return;
      if (exchanges_ || k != 1) continue;
      // The first two sweeps bring the energy near its end.
      least_gain_ = kLeastGain * energy() / static_cast<double>(points_.cols());
    }
  }

  // That of the thread, which keeps the factors of its supports.
  Workspace* workspace() const {
    auto& work = workspaces_[omp_get_thread_num()];
    if (!work) work = std::make_unique<Workspace>(energy_.metric.matrix, control_points_);
    return work.get();
  }

  // Processes color by color. Blocks of one color are independent, so order and threads have no
  // effect.
  bool sweep() {
    std::atomic<bool> changes{false};
    LoopProgress progress(static_cast<Index>(points_.cols()));
    const auto make_work = [&] { return workspace(); };
    const auto visit = [&](Index point, Workspace& work) {
      progress.add(1);
      if (!open_[point] || fixed_[point]) return;
      open_[point] = false;
      if (!improve(point, work)) return;
      changes = true;
      for (const auto& neighbour : graph_.neighbours_of(point)) open_[neighbour.point] = true;
    };
    for (const auto& blocks : graph_.colors()) {
      parallel_for_chunks(static_cast<Index>(blocks.size()), 1, make_work,
                          [&](Index b, Workspace* work) {
                            for (const Index point : blocks[b]) visit(point, *work);
                          });
    }
    return changes;
  }

  // \return whether the weights have changed
  bool improve(Index point, Workspace& work) {
    const double least = std::max(kInvisible, least_gain_ / stiffness_[point]);
    const Index most = options_.max_influences;
    if (exchanges_ || options_.threshold > 0) find_allowed(point, work.may_enter);
    find_supports_around(point, work);
    aim(point, work);
    const PointWeights& before = weights_[point];
    const bool too_many = static_cast<Index>(before.support.size()) > most;
    const double cost = work.selection.qp().cost_of(before);
    PointWeights& best = work.best;
    best = before;
    best.cost = cost;
    work.selection.qp().descend(best);
    if (work.selection.reduce(most, std::numeric_limits<double>::infinity(), best)) {
      for (const auto* support : work.supports) work.selection.adopt(*support, least, best);
      if (exchanges_) work.selection.exchange(most, least, work.may_enter, best);
    } else {
      gather(alone(point, projected_.at(point)), best);
    }
    if (!too_many) {
      if (!(best.cost < cost - least)) return false;
      if (!exchanges_) overshoot(before, best);
    }
    weights_[point] = best;
    moments_.col(point) = moments_of(best);
    return true;
  }

  // For fixed neighbors b, the energy is s (w - t) . H (w - t) and a constant, with the stiffness s
  // = pin m_a + sum_b k_ab and t = given_a + sum_b k_ab (w_b - given_b) / s.
  void aim(Index point, Workspace& work) const {
    find_target(point, work);
    Eigen::VectorXd& pulls = work.selection.qp().aim_at(points_.col(point));
    const auto fill = [&](const std::vector<Index>& some) {
      for (const Index i : some) pulls[i] = pull(i, work);
    };
    fill(weights_[point].support);
    for (const auto* support : work.supports) fill(*support);
    if (exchanges_) fill(work.may_enter);
    clear_target(point, work);
  }

  void find_target(Index point, Workspace& work) const {
    rest_.visit(point, [&](Index i, double value) { work.target[i] = value; });
    work.target_moments = rest_moments_.col(point);
    for (const auto& [neighbour, weight] : graph_.neighbours_of(point)) {
      const double share = weight / stiffness_[point];
      const auto& [support, values, cost] = weights_[neighbour];
      for (std::size_t k = 0; k < support.size(); ++k) work.target[support[k]] += share * values[k];
      work.target_moments += share * moments_.col(neighbour);
    }
  }

  void clear_target(Index point, Workspace& work) const {
    rest_.visit(point, [&](Index i, double) { work.target[i] = 0; });
    for (const auto& neighbour : graph_.neighbours_of(point)) {
      for (const Index i : weights_[neighbour.point].support) work.target[i] = 0;
    }
  }

  // An entry of H t = a t + F^T F t.
  double pull(Index i, const Workspace& work) const {
    return energy_.metric.identity * work.target[i] +
           energy_.metric.factor.col(i).dot(work.target_moments);
  }

  // F w.
  Eigen::VectorXd moments_of(const PointWeights& weights) const {
    Eigen::VectorXd moments = Eigen::VectorXd::Zero(moments_.rows());
    for (std::size_t k = 0; k < weights.support.size(); ++k) {
      moments += weights.values[k] * energy_.metric.factor.col(weights.support[k]);
    }
    return moments;
  }

  void find_allowed(Index point, std::vector<Index>& may_enter) const {
    const double least = std::max(options_.threshold, kLeastInfluence);
    may_enter = weights_[point].support;
    given_.visit(point, [&](Index i, double weight) {
      if (weight >= least) may_enter.push_back(i);
    });
    std::sort(may_enter.begin(), may_enter.end());
    may_enter.erase(std::unique(may_enter.begin(), may_enter.end()), may_enter.end());
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
      if (!masks_.permits(point, support)) continue;
      const auto& may_enter = work.may_enter;
      if (options_.threshold > 0 &&
          !std::includes(may_enter.begin(), may_enter.end(), support.begin(), support.end())) {
        continue;
      }
      const auto is_same = [&](const std::vector<Index>* other) { return *other == support; };
      if (std::none_of(supports.begin(), supports.end(), is_same)) supports.push_back(&support);
    }
  }

  const PoissonEnergy& energy_;
  const EdgeGraph& graph_;
  const PointList<Dim>& control_points_;
  const PointList<Dim>& points_;
  const SparseWeights& given_;
  const SparseWeights& projected_;
  const SparseWeights& given_start_;
  SparsifyOptions options_;
  const PointMasks& masks_;
  PointSparsifier<Dim> sparsifier_;
  std::vector<double> stiffness_;  // per point: the sum of k_ab and pin m_a
  std::vector<char> fixed_;
  std::vector<PointWeights> weights_;
  SparseWeights rest_;                   // per point: given_a - sum_b k_ab given_b / s
  Eigen::MatrixXd rest_moments_;         // r x P: F times these
  Eigen::MatrixXd moments_;              // r x P: F w
  std::vector<std::atomic<bool>> open_;  // per point: whether it may gain
  mutable std::vector<std::unique_ptr<Workspace>> workspaces_;  // per thread
  double least_gain_ = 0;                                       // of a change of one point
  bool exchanges_ = false;  // whether influences may enter that no neighbor has
};

}  // namespace

template <int Dim>
SparseWeights reduce_by_poisson(const PointList<Dim>& control_points, const PointList<Dim>& points,
                                const EdgeList& edges, const SparseWeights& weights,
                                const std::vector<PointList<Dim>>& poses,
                                const SparsifyOptions& options) {
  validate(edges, points.cols());
  validate<Dim>(options);
  const StageScope scope(options.progress);
  constexpr double kStart = 0.3;  // share of the time
  const auto masks = masks_of(options, weights);
  auto projected = [&] {
    const StagePart part(0, kStart / 2);
    return project_non_negative(control_points, points, weights, {}, masks);  // checks the input
  }();
  const auto& given = masks.empty() ? weights : projected;  // masked influences never enter
  // The representatives get numbers in their order, then their places in that of the descent.
  std::vector<Index> place = find_representatives<Dim>(points, given, masks), order;
  for (Index a = 0; a < static_cast<Index>(place.size()); ++a) {
    const bool is_first = place[a] == a;
    place[a] = is_first ? static_cast<Index>(order.size()) : place[place[a]];
    if (is_first) order.push_back(a);
  }
  EdgeList sorted_edges = order.size() < place.size() ? welded_edges(edges, place) : edges;
  const auto energy = make_poisson_energy<Dim>(control_points, points(Eigen::all, order).eval(),
                                               sorted_edges, poses);
  const auto found = breadth_first_order(static_cast<Index>(order.size()), sorted_edges);
  std::vector<Index> rank(order.size());
  for (std::size_t k = 0; k < found.size(); ++k) rank[found[k]] = static_cast<Index>(k);
  renumber(place, rank);
  for (auto& ends : sorted_edges.ends) renumber(ends, rank);
  for (std::size_t a = place.size(); a-- > 0;) order[place[a]] = static_cast<Index>(a);
  const PointList<Dim> sorted_points = points(Eigen::all, order);
  const auto sorted_given = take_points(given, order);
  const auto sorted_projected = projected == given ? sorted_given : take_points(projected, order);
  const Index num_control_points = given.num_control_points(), num_points = given.num_points();
  projected = {};  // frees memory
  SparseWeights sorted_start;
  if (options.start.num_points() > 0) {
    check_size(options.start, control_points.cols(), points.cols());
    sorted_start = take_points(options.start, order);
  }
  SparsifyOptions sorted_options = options;
  for (auto& mask : sorted_options.masks) renumber(mask.points, place);
  const auto sorted_masks = masks_of(sorted_options, sorted_given);
  const EdgeGraph graph(sorted_points, sorted_edges);
  PoissonDescent<Dim> descent(energy, graph, control_points, sorted_points, sorted_given,
                              sorted_projected, sorted_start, options, sorted_masks);
  {
    const StagePart part(kStart / 2, kStart);
    descent.start();
  }
  const StagePart part(kStart, 1);
  descent.run();
  return SparseWeights::of(num_control_points, num_points,
                           [&](Index a) { return descent.weights_of(place[a]); });
}

template <int Dim>
SparseWeights reduce_influences(const PointList<Dim>& control_points, const PointList<Dim>& points,
                                const EdgeList& edges, const SparseWeights& weights,
                                const std::vector<PointList<Dim>>& poses,
                                const SparsifyOptions& options, Reduction reduction) {
  bool has_few = options.threshold == 0;
  for (Index p = 0; p < weights.num_points(); ++p) {
    has_few = has_few && weights.count(p) <= options.max_influences;
  }
  if (reduction == Reduction::kQuadratic || has_few || edges.ends.empty()) {
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
                       edges, before, after);
}

FLBC_INSTANTIATE_FUNCTION(reduce_by_poisson)
FLBC_INSTANTIATE_FUNCTION(reduce_influences)
FLBC_INSTANTIATE_FUNCTION(poisson_cost)

}  // namespace flbc

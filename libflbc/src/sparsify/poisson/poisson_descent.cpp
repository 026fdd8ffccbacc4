// SPDX-License-Identifier: BSD-3-Clause
#include "sparsify/poisson/poisson_descent.h"

#include <algorithm>
#include <limits>

#include "flbc/bounding_box.h"
#include "flbc/cage.h"

namespace flbc {
namespace {

// Steps go beyond the minimum of a row by this factor, as in successive over-relaxation. Below 2
// the energy never rises by that.
constexpr double kOvershoot = 1.5;
// Newcomers must have had this weight: what has next to no influence is far away as a rule, and
// bends of the cage move it otherwise than what is near.
constexpr double kInfluence = 1e-3;
// Supports of neighbours that are tried at a point.
constexpr std::size_t kSupports = 16;
// Gains in squared distance, in units of a tenth of the cage's size, that nobody can see.
constexpr double kInvisible = 1e-11;

void gather(const Eigen::Ref<const Eigen::VectorXd>& weights, SparseRow& row) {
  row.support.clear();
  row.weights.clear();
  for (Index i = 0; i < static_cast<Index>(weights.size()); ++i) {
    if (!(weights[i] > 0)) continue;
    row.support.push_back(i);
    row.weights.push_back(weights[i]);
  }
}

// Beyond the minimum, too, if no control point left: but not more than half the way to zero, so
// that none leaves here.
void overshoot(const SparseRow& before, SparseRow& row) {
  if (!std::includes(row.support.begin(), row.support.end(), before.support.begin(),
                     before.support.end())) {
    return;
  }
  std::vector<double> from(row.support.size(), 0);
  for (std::size_t k = 0, l = 0; l < before.support.size(); ++k) {
    if (row.support[k] == before.support[l]) from[k] = before.weights[l++];
  }
  double factor = kOvershoot;
  for (std::size_t k = 0; k < from.size(); ++k) {
    const double loss = from[k] - row.weights[k];
    if (loss > 0) factor = std::min(factor, 1 + row.weights[k] / (2 * loss));
  }
  for (std::size_t k = 0; k < from.size(); ++k) {
    row.weights[k] = from[k] + factor * (row.weights[k] - from[k]);
  }
}

}  // namespace

template <int Dim>
PoissonDescent<Dim>::PoissonDescent(const PoissonEnergy& energy, const EdgeGraph& graph,
                                    const PointList<Dim>& control_points,
                                    const PointList<Dim>& points, const WeightMatrix& given,
                                    const WeightMatrix& plain, const SparsifyOptions& options)
    : energy_(energy),
      graph_(graph),
      control_points_(control_points),
      points_(points),
      given_(given),
      plain_(plain),
      options_(options),
      stiffness_(points.cols()),
      fixed_(points.cols()),
      rows_(points.cols()),
      potential_(given.rows(), given.cols()),
      open_(points.cols()) {
  for (Index a = 0; a < static_cast<Index>(points.cols()); ++a) {
    stiffness_[a] = energy.pin * graph.mass(a);
    for (const auto& neighbour : graph.neighbours_of(a)) stiffness_[a] += neighbour.weight;
    // On the cage weights are those of its facet.
    fixed_[a] = (given.col(a).array() != 0).count() <= Dim && plain.col(a) == given.col(a);
  }
}

template <int Dim>
void PoissonDescent<Dim>::start(const WeightMatrix& weights) {
  const auto num_points = static_cast<Index>(points_.cols());
#pragma omp parallel for schedule(static) if (num_points >= 256)
  for (Index a = 0; a < num_points; ++a) {
    gather(weights.col(a), rows_[a]);
    potential_.col(a).noalias() = energy_.metric * (weights.col(a) - given_.col(a));
  }
  // Where all differences are 0 there is nothing to gain, but maybe something to remove.
  std::fill(open_.begin(), open_.end(), 0);
  for (Index a = 0; a < num_points; ++a) {
    if (static_cast<Index>(rows_[a].support.size()) > options_.max_influences) open_[a] = 1;
    if (weights.col(a) == given_.col(a)) continue;
    open_[a] = 1;
    for (const auto& neighbour : graph_.neighbours_of(a)) open_[neighbour.point] = 1;
  }
}

template <int Dim>
void PoissonDescent<Dim>::run(int sweeps, double least_gain) {
  for (int k = 0; k < sweeps; ++k) {
    if (!sweep(least_gain)) return;
  }
}

// Color by color: points of one color do not see each other, so that their order and the threads
// do not matter.
template <int Dim>
bool PoissonDescent<Dim>::sweep(double least_gain) {
  const double size = std::max(bounding_box_diagonal<Dim>(control_points_), std::numeric_limits<double>::min());
  Index changes = 0;
#pragma omp parallel reduction(+ : changes) if (points_.cols() >= 256)
  {
    Workspace work(energy_.metric, control_points_, size);
    for (const auto& color : graph_.colors()) {
      const auto count = static_cast<Index>(color.size());
#pragma omp for schedule(dynamic, 16)
      for (Index k = 0; k < count; ++k) {
        const Index point = color[k];
        if (!open_[point] || fixed_[point]) continue;
        open_[point] = 0;
        if (!improve(point, least_gain, work)) continue;
        ++changes;
        for (const auto& neighbour : graph_.neighbours_of(point)) {
#pragma omp atomic write
          open_[neighbour.point] = 1;
        }
      }
    }
  }
  return changes > 0;
}

// \return whether the row has changed
template <int Dim>
bool PoissonDescent<Dim>::improve(Index point, double least_gain, Workspace& work) {
  const double least = std::max(kInvisible, least_gain / stiffness_[point]);
  const Index most = options_.max_influences;
  aim(point, work);
  const SparseRow& before = rows_[point];
  const bool too_many = static_cast<Index>(before.support.size()) > most;
  const double cost = work.row.cost_of(before);
  SparseRow& best = work.best;
  best = before;
  work.row.descend(best);
  if (!work.search.reduce(most, std::numeric_limits<double>::infinity(), best)) {
    gather(plain_.col(point), best);
    best.cost = work.row.cost_of(best);
  }
  find_allowed(point, work.may_enter);
  find_supports_around(point, work);
  for (const auto* support : work.supports) work.search.adopt(*support, least, best);
  work.search.exchange(most, least, work.may_enter, best);
  if (!too_many) {
    if (!(best.cost < cost - least)) return false;
    overshoot(before, best);
  }
  update(point, best);
  return true;
}

// For fixed neighbours b the energy is s (w - t) . H (w - t) and a constant, with the stiffness
// s = pin m_a + sum_b k_ab and t = given + sum_b k_ab d_b / s.
template <int Dim>
void PoissonDescent<Dim>::aim(Index point, Workspace& work) const {
  Eigen::VectorXd& pull = work.row.aim_at(points_.col(point));
  pull = -potential_.col(point);
  const SparseRow& row = rows_[point];
  for (std::size_t k = 0; k < row.support.size(); ++k) {
    pull += row.weights[k] * energy_.metric.col(row.support[k]);
  }
  for (const auto& [neighbour, weight] : graph_.neighbours_of(point)) {
    pull += weight / stiffness_[point] * potential_.col(neighbour);
  }
}

template <int Dim>
void PoissonDescent<Dim>::find_allowed(Index point, std::vector<bool>& may_enter) const {
  const double least = std::max(options_.threshold, kInfluence);
  may_enter.resize(given_.rows());
  for (Index i = 0; i < static_cast<Index>(given_.rows()); ++i) {
    may_enter[i] = given_(i, point) >= least || plain_(i, point) > 0;
  }
}

// What suits a neighbour often suits here, too, and then there is no seam between them.
template <int Dim>
void PoissonDescent<Dim>::find_supports_around(Index point, Workspace& work) const {
  auto& supports = work.supports;
  supports.clear();
  for (const auto& neighbour : graph_.neighbours_of(point)) {
    if (supports.size() == kSupports) return;
    const auto& support = rows_[neighbour.point].support;
    if (static_cast<Index>(support.size()) > options_.max_influences) continue;
    const auto may_enter = [&](Index i) { return work.may_enter[i]; };
    if (options_.threshold > 0 && !std::all_of(support.begin(), support.end(), may_enter)) continue;
    const auto is_same = [&](const std::vector<Index>* other) { return *other == support; };
    if (std::none_of(supports.begin(), supports.end(), is_same)) supports.push_back(&support);
  }
}

template <int Dim>
void PoissonDescent<Dim>::update(Index point, const SparseRow& row) {
  const auto add = [&](const SparseRow& any, double sign) {
    for (std::size_t k = 0; k < any.support.size(); ++k) {
      potential_.col(point) += sign * any.weights[k] * energy_.metric.col(any.support[k]);
    }
  };
  add(rows_[point], -1);
  add(row, 1);
  rows_[point] = row;
}

template <int Dim>
Eigen::VectorXd PoissonDescent<Dim>::weights_of(Index point) const {
  Eigen::VectorXd weights = Eigen::VectorXd::Zero(given_.rows());
  const SparseRow& row = rows_[point];
  for (std::size_t k = 0; k < row.support.size(); ++k) weights[row.support[k]] = row.weights[k];
  return weights;
}

template class PoissonDescent<2>;
template class PoissonDescent<3>;

}  // namespace flbc

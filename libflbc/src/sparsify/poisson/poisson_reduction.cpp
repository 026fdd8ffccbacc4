// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/sparsify.h"

#include <algorithm>

#include "base/shape_checks.h"
#include "base/stage_progress.h"
#include "polytope/weight_projection.h"
#include "sparsify/poisson/edge_graph.h"
#include "sparsify/poisson/poisson_descent.h"
#include "sparsify/poisson/poisson_energy.h"

namespace flbc {
namespace {

constexpr int kSweeps = 20;
// Least gain of a change of one point's weights, as a part of the mean energy of a point.
constexpr double kLeastGain = 1e-3;

// The control points with a weight, ascending.
std::vector<Index> support_of(const Eigen::VectorXd& weights) {
  std::vector<Index> support;
  for (Index i = 0; i < static_cast<Index>(weights.size()); ++i) {
    if (weights[i] > 0) support.push_back(i);
  }
  return support;
}

// The weights of the descent with exact sum and reproduction; where rounding is in the way, or
// nothing is connected, the plain weights.
template <int Dim>
WeightMatrix polished(const PoissonDescent<Dim>& descent, const EdgeGraph& graph,
                      const WeightProjection<Dim>& projection, const PointList<Dim>& points,
                      const WeightMatrix& plain) {
  WeightMatrix result = plain;
  const auto num_points = static_cast<Index>(plain.cols());
#pragma omp parallel for schedule(dynamic, 64) if (num_points >= 256)
  for (Index a = 0; a < num_points; ++a) {
    const Index representative = graph.representative(a);
    const auto neighbours = graph.neighbours_of(representative);
    if (neighbours.begin() == neighbours.end()) continue;
    const Eigen::VectorXd weights = descent.weights_of(representative);
    if (weights == plain.col(a)) continue;
    Eigen::VectorXd exact;
    if (projection.project(points.col(a), support_of(weights), weights, exact)) {
      result.col(a) = exact;
    }
  }
  return result;
}

// With one influence more to begin with, neighbours can agree on which one to drop.
template <int Dim>
WeightMatrix with_one_more(const PointList<Dim>& control_points, const PointList<Dim>& points,
                           const WeightMatrix& weights, SparsifyOptions options) {
  if (options.max_influences < static_cast<Index>(weights.rows())) ++options.max_influences;
  return sparsify(control_points, points, weights, options);
}

}  // namespace

template <int Dim>
WeightMatrix reduce_by_poisson(const PointList<Dim>& control_points, const PointList<Dim>& points,
                               const EdgeList& edges, const WeightMatrix& weights,
                               const std::vector<PointList<Dim>>& poses,
                               const SparsifyOptions& user_options) {
  validate(edges, points.cols());
  // About as long as each of them takes.
  constexpr double kPlain = 0.15, kStart = 0.3;
  const StageScope scope(user_options.progress);
  SparsifyOptions options = user_options;
  options.progress = {};  // told by the scope
  auto plain = [&] {
    const StagePart part(0, kPlain);
    return sparsify(control_points, points, weights, options);  // checks the input, too
  }();
  const auto energy = make_poisson_energy<Dim>(control_points, points, edges, poses);
  const double plain_cost = evaluate<Dim>(energy, points, edges, weights, plain);
  if (!(plain_cost > 0)) return plain;

  const EdgeGraph graph(points, weights, edges);
  const WeightProjection<Dim> projection(control_points);
  PoissonDescent<Dim> descent(energy, graph, control_points, points, weights, plain, options);
  const auto descend_from = [&](const WeightMatrix& start) {
    const StagePart part(kStart, 1);
    descent.start(start);
    descent.run(kSweeps, kLeastGain * plain_cost / static_cast<double>(points.cols()));
    return polished(descent, graph, projection, points, plain);
  };
  const auto is_better = [&](const WeightMatrix& result) {
    return evaluate<Dim>(energy, points, edges, weights, result) < plain_cost;
  };
  const auto start = [&] {
    const StagePart part(kPlain, kStart);
    return with_one_more(control_points, points, weights, options);
  }();
  auto result = descend_from(start);
  if (is_better(result)) return result;
  result = descend_from(plain);
  return is_better(result) ? result : plain;
}

template <int Dim>
double poisson_cost(const PointList<Dim>& control_points, const PointList<Dim>& points,
                    const EdgeList& edges, const WeightMatrix& before, const WeightMatrix& after,
                    const std::vector<PointList<Dim>>& poses) {
  check_size(before, control_points.cols(), points.cols());
  check_size(after, control_points.cols(), points.cols());
  validate(edges, points.cols());
  return evaluate<Dim>(make_poisson_energy<Dim>(control_points, points, edges, poses), points,
                       edges, before, after);
}

#define FLBC_INSTANTIATE(Dim)                                                                 \
  template WeightMatrix reduce_by_poisson(                                                    \
      const PointList<Dim>&, const PointList<Dim>&, const EdgeList&, const WeightMatrix&,     \
      const std::vector<PointList<Dim>>&, const SparsifyOptions&);                            \
  template double poisson_cost(const PointList<Dim>&, const PointList<Dim>&, const EdgeList&, \
                               const WeightMatrix&, const WeightMatrix&,                      \
                               const std::vector<PointList<Dim>>&);
FLBC_INSTANTIATE(2)
FLBC_INSTANTIATE(3)
#undef FLBC_INSTANTIATE

}  // namespace flbc

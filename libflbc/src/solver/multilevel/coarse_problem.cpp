// SPDX-License-Identifier: BSD-3-Clause
#include "solver/multilevel/coarse_problem.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "base/instantiate.h"
#include "base/parallel.h"
#include "base/stage_progress.h"
#include "flbc/errors.h"
#include "problem/geodesic/interpolated_distances.h"
#include "solver/plan/choices.h"
#include "solver/plan/constants.h"

namespace flbc {
namespace {

// A sample of control points, evenly spaced in the order of their largest distance to the domain.
std::vector<Index> choose_control_points(const DistanceMatrix& distances) {
  const auto n = static_cast<Index>(distances.rows());
  const Index count = std::min(n, plan::kCheckedControlPoints);
  const Eigen::VectorXf farthest = distances.rowwise().maxCoeff();
  std::vector<Index> order(n);
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](Index a, Index b) { return farthest[a] > farthest[b]; });
  std::vector<Index> chosen;
  chosen.reserve(static_cast<std::size_t>(count));
  for (Index k = 0; k < count; ++k) chosen.push_back(order[k * (n - 1) / std::max(1, count - 1)]);
  return chosen;
}

// Inserts exact distances for some control points and returns the error of phi there.
template <int Dim>
double check_on_sample(const LbcProblem<Dim>& problem, DistanceScheme scheme,
                       DistanceMatrix& distances) {
  const auto chosen = choose_control_points(distances);
  const auto count = static_cast<Index>(chosen.size());
  std::vector<Index> sources;
  DistanceMatrix both(2 * count, distances.cols());
  for (Index k = 0; k < count; ++k) {
    sources.push_back(problem.boundary.control_vertices[chosen[k]]);
    both.row(k) = distances.row(chosen[k]);
  }
  both.bottomRows(count) = geodesic_distances(problem.mesh, problem.topology, sources);
  for (Index k = 0; k < count; ++k) {
    distances.row(chosen[k]) = both.row(count + k);
  }
  const WeightFunctions phi(scheme, std::move(both), problem.mesh, 2 * count);
  const Eigen::Vector2d zero = Eigen::Vector2d::Zero();
  const auto squares = parallel_sum(problem.mesh.num_cells(), zero, [&](Index begin, Index end) {
    Eigen::Vector2d sum = zero;  // of the differences, and of phi
    for (Index s = begin; s < end; ++s) {
      const Eigen::VectorXd on_cell = phi.col(s);
      sum[0] += (on_cell.head(count) - on_cell.tail(count)).squaredNorm();
      sum[1] += on_cell.tail(count).squaredNorm();
    }
    return sum;
  });
  return std::sqrt(squares[0] / squares[1]);
}

// Distances from the coarse mesh; exact ones if their effect on the weights is too large.
template <int Dim>
DistanceMatrix choose_distances(const CoarseProblem<Dim>& coarse, const LbcProblem<Dim>& problem,
                                const plan::Settings& settings, DistanceReport& report) {
  auto distances = interpolated_distances<Dim>(problem.cage.points, problem.mesh.points,
                                               coarse.ends, coarse.problem.phi.distances());
  const double error = check_on_sample(problem, settings.phi, distances);
  if (!plan::interpolates(settings, error)) return distances_for(settings.phi, problem);
  report = {Distances::kInterpolated, coarse.problem.mesh.num_vertices(), error};
  return distances;
}

// Those of the vertices that both meshes have.
template <int Dim>
PointMasks masks_on_coarse(const PointMasks& masks, const CoarseProblem<Dim>& coarse) {
  std::vector<Mask> on_coarse;
  for (Index v = 0; v < static_cast<Index>(coarse.ends.size()); ++v) {
    const auto [a, b] = coarse.ends[v];
    const auto& boundary = coarse.problem.boundary;
    if (a == b && masks.at(v) && boundary.is_interior(a)) {
      on_coarse.push_back({masks.forbidden(v), {a}});
    }
  }
  if (on_coarse.empty()) return {};
  return {on_coarse, coarse.problem.num_control_points(), coarse.problem.mesh.num_vertices()};
}

// For any method.
template <int Dim>
std::optional<CoarseProblem<Dim>> make_coarse(const LbcProblem<Dim>& problem, DistanceScheme phi,
                                              double falloff) {
  auto coarse = coarse_mesh(problem.mesh);
  if (!coarse) return {};
  std::optional<CoarseProblem<Dim>> made;
  try {
    made.emplace(CoarseProblem<Dim>{make_geometry(problem.cage, std::move(coarse->mesh)),
                                    std::move(coarse->ends)});
  } catch (const InputError&) {  // the coarse mesh may lack control points
    return {};
  }
  made->problem.smoothness = problem.smoothness;
  made->problem.masks = masks_on_coarse(problem.masks, *made);
  made->problem.phi.set_reach(problem.phi.reach());
  set_phi(made->problem, phi);
  set_falloff(made->problem, falloff);
  return made;
}

// Means over the parts of each cell.
WeightFunctions on_coarse_cells(const WeightFunctions& phi, Index num_cells) {
  const auto parts = phi.cols() / num_cells;
  Eigen::MatrixXd means = Eigen::MatrixXd::Zero(phi.rows(), num_cells);
  for (Eigen::Index s = 0; s < phi.cols(); ++s) {
    means.col(s / parts) += phi.col(s) / static_cast<double>(parts);
  }
  return means;
}

}  // namespace

template <int Dim>
std::optional<CoarseProblem<Dim>> coarse_problem(const LbcProblem<Dim>& problem,
                                                 const plan::Settings& settings) {
  if (!plan::inherits(settings.method)) return {};
  if (!problem.phi.is_given()) return make_coarse(problem, settings.phi, settings.falloff);
  auto coarse = make_coarse(problem, DistanceScheme::kConstant, 0);
  if (coarse) coarse->problem.phi = on_coarse_cells(problem.phi, coarse->problem.mesh.num_cells());
  return coarse;
}

template <int Dim>
NestedProblem<Dim> set_up(LbcProblem<Dim> geometry, const plan::Settings& settings,
                          const Reporter& reporter) {
  const StageScope scope(reporter.stage(Stage::kDistances));
  NestedProblem<Dim> nested{std::move(geometry)};
  auto& [problem, coarse, report] = nested;
  problem.smoothness = *settings.smoothness;
  problem.phi.set_reach(settings.reach);
  if (plan::inherits(settings.method) || settings.distances == Distances::kInterpolated) {
    coarse = make_coarse(problem, settings.phi, settings.falloff);
  }
  set_phi(problem, settings.phi,
          coarse && plan::interpolates(settings, 0)
              ? choose_distances(*coarse, problem, settings, report)
              : distances_for(settings.phi, problem));
  set_falloff(problem, settings.falloff);
  if (!plan::inherits(settings.method)) coarse.reset();
  return nested;
}

FLBC_INSTANTIATE_FUNCTION(coarse_problem)
FLBC_INSTANTIATE_FUNCTION(set_up)

}  // namespace flbc

// SPDX-License-Identifier: BSD-3-Clause
#include "solver/multilevel/coarse_distances.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>
#include <vector>

#include "base/instantiate.h"
#include "base/parallel.h"
#include "flbc/interpolate.h"
#include "mesh/cell_geometry.h"
#include "problem/problem_geometry.h"
#include "solver/plan/choices.h"
#include "solver/plan/constants.h"
#include "solver/start/transfer.h"

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

// Nearly flat cells make distances slow and inaccurate. Problems are scaled to one size.
template <int Dim>
bool folds(const DomainMesh<Dim>& before, const DomainMesh<Dim>& after) {
  constexpr double kLeast = 1e-3;  // relative to the measure of the cell before
  for (Index s = 0; s < after.num_cells(); ++s) {
    if (signed_measure(after, s) < kLeast * signed_measure(before, s)) return true;
  }
  return false;
}

}  // namespace

template <int Dim>
DistanceMatrix choose_distances(const CoarseProblem<Dim>& coarse, const LbcProblem<Dim>& problem,
                                const plan::Settings& settings, DistanceReport& report) {
  auto distances = distances_from(coarse.problem, problem, coarse.finest_vertices);
  const double error = check_on_sample(problem, settings.phi, distances);
  if (settings.distances == Distances::kAuto &&
      !plan::accepts_phi_error(error, *settings.tolerance)) {
    report = {};
    return distances_for(settings.phi, problem);
  }
  report = {Distances::kInterpolated, coarse.problem.mesh.num_vertices(), error};
  return distances;
}

template <int Dim>
MovingDistances<Dim>::MovingDistances(CoarseProblem<Dim> coarse, const LbcProblem<Dim>& fine)
    : coarse_(std::move(coarse)),
      first_(coarse_.problem.mesh),
      places_(places_in(fine, coarse_.problem.mesh.points)) {
}

template <int Dim>
void MovingDistances<Dim>::anchor(const DomainMesh<Dim>& fine, const SparseWeights& weights) {
  weights_ = interpolate(fine, weights, places_).dense();
  coarse_.problem.boundary.impose_on(weights_);
}

template <int Dim>
DistanceMatrix MovingDistances<Dim>::operator()(const LbcProblem<Dim>& fine,
                                                const plan::Settings& settings,
                                                DistanceReport& report) {
  auto& problem = coarse_.problem;
  DomainMesh<Dim> mesh{fine.cage.points * weights_, problem.mesh.cells};
  if (folds(first_, mesh)) {
    report = {};
    return distances_for(settings.phi, fine);
  }
  problem.cage = fine.cage;
  problem.scale = fine.scale;
  problem.mesh = std::move(mesh);
  set_phi(problem, settings.phi);
  return choose_distances(coarse_, fine, settings, report);
}

FLBC_INSTANTIATE_FUNCTION(choose_distances)
template class MovingDistances<2>;
template class MovingDistances<3>;

}  // namespace flbc

// SPDX-License-Identifier: BSD-3-Clause
#include "solver/multilevel/moving_distances.h"

#include <utility>

#include "flbc/interpolate.h"
#include "mesh/cell_geometry.h"
#include "problem/problem_geometry.h"
#include "solver/multilevel/choose_distances.h"
#include "solver/start/transfer.h"

namespace flbc {
namespace {

// Cells that are as good as flat make distances slow and wrong. Problems are scaled to one size.
template <int Dim>
bool folds(const DomainMesh<Dim>& before, const DomainMesh<Dim>& after) {
  constexpr double kLeast = 1e-3;  // of the cell's measure before
  for (Index s = 0; s < after.num_cells(); ++s) {
    if (signed_measure(after, s) < kLeast * signed_measure(before, s)) return true;
  }
  return false;
}

}  // namespace

template <int Dim>
MovingDistances<Dim>::MovingDistances(CoarseProblem<Dim> coarse, const LbcProblem<Dim>& fine)
    : coarse_(std::move(coarse)),
      first_(coarse_.problem.mesh),
      places_(places_in(fine, coarse_.problem.mesh.points)) {
  coarse_.reach = {};
}

template <int Dim>
void MovingDistances<Dim>::anchor(const DomainMesh<Dim>& fine, const WeightMatrix& weights) {
  weights_ = interpolate(fine, weights, places_);
  coarse_.problem.boundary.impose_on(weights_);
}

template <int Dim>
DistanceMatrix MovingDistances<Dim>::operator()(const LbcProblem<Dim>& fine,
                                                const SolverOptions& options,
                                                DistanceReport& report) {
  auto& problem = coarse_.problem;
  DomainMesh<Dim> mesh{fine.cage.points * weights_, problem.mesh.cells};
  if (folds(first_, mesh)) {
    report = {};
    return distances_for(options.phi, fine);
  }
  problem.cage = fine.cage;
  problem.scale = fine.scale;
  problem.mesh = std::move(mesh);
  set_phi(problem, options.phi);
  return choose_distances(coarse_, fine, options, report);
}

template class MovingDistances<2>;
template class MovingDistances<3>;

}  // namespace flbc

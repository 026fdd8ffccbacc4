// SPDX-License-Identifier: BSD-3-Clause
#include "solver/warm_start/transfer.h"

#include <utility>

#include "flbc/bounding_box.h"
#include "flbc/interpolate.h"
#include "mesh/cell_geometry.h"
#include "mesh/cell_walk.h"
#include "solver/warm_start/flux_length.h"

namespace flbc {

template <int Dim>
double enlargement(const LbcProblem<Dim>& coarse, const LbcProblem<Dim>& fine) {
  return bounding_box_diagonal(fine.cage.points) / bounding_box_diagonal(coarse.cage.points);
}

// Both meshes fill the same cage, whose control points tell how one lies in the other's space.
template <int Dim>
PointList<Dim> points_in_coarse(const LbcProblem<Dim>& coarse, const LbcProblem<Dim>& fine,
                                const PointList<Dim>& fine_points) {
  const Vector<Dim> origin = fine.cage.points.col(0);
  return ((fine_points.colwise() - origin) / enlargement(coarse, fine)).colwise() +
         coarse.cage.points.col(0);
}

template <int Dim>
std::vector<Location<Dim>> places_in_coarse(const LbcProblem<Dim>& coarse,
                                            const LbcProblem<Dim>& fine,
                                            const PointList<Dim>& fine_points) {
  return walk_to_points(coarse.mesh, coarse.topology, points_in_coarse(coarse, fine, fine_points));
}

template <int Dim>
Transfer<Dim>::Transfer(Unlocated, const LbcProblem<Dim>& coarse, const MeshState<Dim>& state,
                        const LbcProblem<Dim>& fine)
    : coarse_(coarse), state_(state), fine_(fine), enlargement_(enlargement(coarse, fine)) {
}

template <int Dim>
Transfer<Dim>::Transfer(const LbcProblem<Dim>& coarse, const MeshState<Dim>& state,
                        const LbcProblem<Dim>& fine, std::vector<Location<Dim>> vertices)
    : Transfer(Unlocated{}, coarse, state, fine) {
  vertices_ =
      vertices.empty() ? places_in_coarse(coarse, fine, fine.mesh.points) : std::move(vertices);
  for (const auto& place :
       places_in_coarse(coarse, fine, centroids(fine.mesh.points, fine.mesh.cells))) {
    cells_.push_back(place.cell);
  }
  if (state.potential.size() > 0) {
    facets_ = places_in_coarse(coarse, fine, centroids(fine.mesh.points, fine.topology.facets));
  }
}

template <int Dim>
Transfer<Dim> Transfer<Dim>::between_shapes(const LbcProblem<Dim>& before,
                                            const MeshState<Dim>& state,
                                            const LbcProblem<Dim>& after) {
  using Coordinates = Eigen::Matrix<double, Dim + 1, 1>;
  Transfer transfer(Unlocated{}, before, state, after);
  transfer.between_shapes_ = true;
  const auto& mesh = before.mesh;
  const auto& topology = before.topology;
  transfer.vertices_.resize(mesh.num_vertices());
  transfer.cells_.resize(mesh.num_cells());
  if (state.potential.size() > 0) transfer.facets_.resize(topology.num_facets());
  for (Index s = 0; s < mesh.num_cells(); ++s) {
    transfer.cells_[s] = s;
    for (int k = 0; k <= Dim; ++k) {
      transfer.vertices_[mesh.cells(k, s)] = {s, Coordinates::Unit(k)};
      if (transfer.facets_.empty()) continue;
      Coordinates middle = Coordinates::Constant(1.0 / Dim);
      middle[k] = 0;
      transfer.facets_[topology.cell_facets(k, s)] = {s, middle};
    }
  }
  return transfer;
}

// n x V
template <int Dim>
WeightMatrix Transfer<Dim>::at_vertices(const SparseWeights& coarse) const {
  WeightMatrix fine(coarse.num_control_points(), fine_.mesh.num_vertices());
#pragma omp parallel for schedule(static)
  for (Index v = 0; v < fine_.mesh.num_vertices(); ++v) {
    fine.col(v) = interpolate(coarse_.mesh, coarse, vertices_[v]);
  }
  return fine;
}

template <int Dim>
WeightMatrix Transfer<Dim>::weights() const {
  auto weights = at_vertices(state_.weights);
  fine_.boundary.impose_on(weights);
  return weights;
}

template <int Dim>
Eigen::VectorXd Transfer<Dim>::weights_at(Index vertex) const {
  return interpolate(coarse_.mesh, state_.weights, vertices_[vertex]);
}

template <int Dim>
Eigen::Matrix<double, Eigen::Dynamic, Dim> Transfer<Dim>::flux_density(Index cell) const {
  auto density = state_.flux_density.cell(cells_[cell]);
  shorten_to(fine_.phi, cell, density);
  return density;
}

template <int Dim>
WeightMatrix Transfer<Dim>::vertex_dual(double penalty) const {
  if (state_.vertex_dual.num_points() == 0) return {};
  return this->penalty() / penalty * at_vertices(state_.vertex_dual);
}

template <int Dim>
VectorsAt<1> Transfer<Dim>::vertex_dual_at(double penalty) const {
  if (state_.vertex_dual.num_points() == 0) return {};
  return [this, factor = this->penalty() / penalty](Index vertex) -> Eigen::VectorXd {
    return factor * interpolate(coarse_.mesh, state_.vertex_dual, vertices_[vertex]);
  };
}

template <int Dim>
Eigen::Matrix<double, Eigen::Dynamic, Dim> Transfer<Dim>::facet_multiplier(Index facet) const {
  return flbc::facet_multiplier<Dim>(
      fine_, facet, enlargement_ * evaluate_potential(coarse_, state_.potential, facets_[facet]));
}

#define FLBC_INSTANTIATE(Dim)                                                              \
  template double enlargement(const LbcProblem<Dim>&, const LbcProblem<Dim>&);             \
  template PointList<Dim> points_in_coarse(const LbcProblem<Dim>&, const LbcProblem<Dim>&, \
                                           const PointList<Dim>&);                         \
  template std::vector<Location<Dim>> places_in_coarse(                                    \
      const LbcProblem<Dim>&, const LbcProblem<Dim>&, const PointList<Dim>&);              \
  template class Transfer<Dim>;
FLBC_INSTANTIATE(2)
FLBC_INSTANTIATE(3)
#undef FLBC_INSTANTIATE

}  // namespace flbc

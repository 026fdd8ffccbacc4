// SPDX-License-Identifier: BSD-3-Clause
#include "solver/start/transfer.h"

#include <utility>

#include "flbc/interpolate.h"
#include "mesh/cell_geometry.h"
#include "solver/start/flux_length.h"

namespace flbc {

template <int Dim>
Transfer<Dim>::Transfer(Unlocated, const LbcProblem<Dim>& coarse, const Duals<Dim>& duals,
                        const LbcProblem<Dim>& fine)
    : coarse_(coarse), duals_(duals), fine_(fine) {
}

template <int Dim>
Transfer<Dim>::Transfer(const LbcProblem<Dim>& coarse, const Duals<Dim>& duals,
                        const LbcProblem<Dim>& fine, std::vector<Location<Dim>> vertices)
    : Transfer(Unlocated{}, coarse, duals, fine) {
  vertices_ = vertices.empty() ? places_in(coarse, fine.mesh.points) : std::move(vertices);
  for (const auto& place : places_in(coarse, centroids(fine.mesh.points, fine.mesh.cells))) {
    cells_.push_back(place.cell);
  }
}

template <int Dim>
Transfer<Dim> Transfer<Dim>::between_shapes(const LbcProblem<Dim>& before, const Duals<Dim>& duals,
                                            const LbcProblem<Dim>& after) {
  Transfer transfer(Unlocated{}, before, duals, after);
  transfer.between_shapes_ = true;
  const auto& mesh = before.mesh;
  transfer.vertices_.resize(mesh.num_vertices());
  transfer.cells_.resize(mesh.num_cells());
  for (Index s = 0; s < mesh.num_cells(); ++s) {
    transfer.cells_[s] = s;
    for (int k = 0; k <= Dim; ++k) {
      transfer.vertices_[mesh.cells(k, s)] = {s, Eigen::Matrix<double, Dim + 1, 1>::Unit(k)};
    }
  }
  return transfer;
}

template <int Dim>
Eigen::VectorXd Transfer<Dim>::weights_at(Index vertex) const {
  return interpolate(coarse_.mesh, duals_.weights, vertices_[vertex]);
}

template <int Dim>
Eigen::Matrix<double, Eigen::Dynamic, Dim> Transfer<Dim>::flux_density(Index cell) const {
  auto density = duals_.flux_density.cell(cells_[cell]);
  shorten_to(fine_.phi, cell, density);
  return density;
}

template <int Dim>
Start<Dim> Transfer<Dim>::start() const {
  Start<Dim> start;
  start.penalty = duals_.penalty;
  start.weights = [this](Index v) { return weights_at(v); };
  start.flux_density = [this](Index s) { return flux_density(s); };
  if (duals_.vertex_dual.num_points() > 0) {
    start.vertex_dual = [this](Index v) -> Eigen::VectorXd {
      return interpolate(coarse_.mesh, duals_.vertex_dual, vertices_[v]);
    };
  }
  return start;
}

template class Transfer<2>;
template class Transfer<3>;

}  // namespace flbc

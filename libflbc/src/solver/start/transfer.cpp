// SPDX-License-Identifier: BSD-3-Clause
#include "solver/start/transfer.h"

#include <utility>

#include "flbc/interpolate.h"
#include "mesh/cell_geometry.h"

namespace flbc {

template <int Dim>
Transfer<Dim>::Transfer(const LbcProblem<Dim>& coarse, const Duals<Dim>& duals,
                        const LbcProblem<Dim>& fine, std::vector<Location<Dim>> vertices)
    : Transfer(coarse, duals, fine, false) {
  vertices_ = vertices.empty() ? places_in(coarse, fine.mesh.points) : std::move(vertices);
  for (const auto& place : places_in(coarse, centroids(fine.mesh.points, fine.mesh.cells))) {
    cells_.push_back(place.cell);
  }
}

template <int Dim>
Transfer<Dim> Transfer<Dim>::between_shapes(const LbcProblem<Dim>& before, const Duals<Dim>& duals,
                                            const LbcProblem<Dim>& after) {
  Transfer transfer(before, duals, after, true);
  const auto& mesh = before.mesh;
  transfer.vertices_.resize(mesh.num_vertices());
  for (Index s = 0; s < mesh.num_cells(); ++s) {
    transfer.cells_.push_back(s);
    for (int k = 0; k <= Dim; ++k) {
      transfer.vertices_[mesh.cells(k, s)] = {s, Eigen::Matrix<double, Dim + 1, 1>::Unit(k)};
    }
  }
  return transfer;
}

template <int Dim>
Start<Dim> Transfer<Dim>::start() const {
  const auto interpolated = [this](const SparseWeights& numbers) -> VectorsAt<1> {
    return [this, &numbers](Index v) -> Eigen::VectorXd {
      return interpolate(coarse_.mesh, numbers, vertices_[v]);
    };
  };
  Start<Dim> start;
  start.penalty = duals_.penalty;
  start.weights = interpolated(duals_.weights);
  start.flux_density = [this](Index s) {
    auto density = duals_.flux_density.cell(cells_[s]);
    make_admissible(fine_, s, density);
    return density;
  };
  if (duals_.vertex_dual.num_points() > 0) start.vertex_dual = interpolated(duals_.vertex_dual);
  return start;
}

template class Transfer<2>;
template class Transfer<3>;

}  // namespace flbc

// SPDX-License-Identifier: BSD-3-Clause
#include "solver/start/transfer.h"

namespace flbc {

template <int Dim>
Start<Dim> Transfer<Dim>::start() const {
  const auto interpolated = [this](const SparseWeights& numbers) -> VectorsAt<1> {
    return [this, &numbers](Index v) -> Eigen::VectorXd {
      const auto [a, b] = ends_of(v);
      return (numbers.at(a) + numbers.at(b)) / 2;
    };
  };
  const Index parts = to_.mesh.num_cells() / from_.mesh.num_cells();
  Start<Dim> start;
  start.penalty = duals_.penalty;
  start.weights = interpolated(duals_.weights);
  start.flux_density = [this, parts](Index s) {
    auto density = duals_.flux_density.cell(s / parts);
    make_admissible(to_, s, density);
    return density;
  };
  if (duals_.vertex_dual.num_points() > 0) start.vertex_dual = interpolated(duals_.vertex_dual);
  return start;
}

template class Transfer<2>;
template class Transfer<3>;

}  // namespace flbc

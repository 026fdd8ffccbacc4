// SPDX-License-Identifier: BSD-3-Clause
#include "solver/start/prolongation.h"

namespace flbc {

template <int Dim>
Start<Dim> Prolongation<Dim>::start() const {
  const auto interpolated = [this](const SparseWeights& numbers) -> VectorsAt<1> {
    return [this, &numbers](Index v) -> Eigen::VectorXd {
      const auto [a, b] = ends_of(v);
      return (numbers.at(a) + numbers.at(b)) / 2;
    };
  };
  const Index parts = to_.mesh.num_cells() / from_.mesh.num_cells();
  Start<Dim> start;
  start.penalty = warm_start_.penalty;
  start.weights = interpolated(warm_start_.weights);
  start.flux_density = [this, parts](Index s) {
    auto density = warm_start_.flux_density.cell(s / parts);
    make_admissible(to_, s, density);
    return density;
  };
  if (warm_start_.vertex_dual.num_points() > 0)
    start.vertex_dual = interpolated(warm_start_.vertex_dual);
  return start;
}

template class Prolongation<2>;
template class Prolongation<3>;

}  // namespace flbc

// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/interpolate.h"

#include "base/weight_columns.h"

namespace flbc {

template <int Dim>
WeightMatrix interpolate(const DomainMesh<Dim>& mesh, const WeightMatrix& weights,
                         const std::vector<Location<Dim>>& places) {
  return weights_of_points<WeightMatrix>(
      static_cast<Index>(weights.rows()), static_cast<Index>(places.size()),
      [&](Index p) { return interpolate(mesh, weights, places[p]); });
}

template <int Dim, class Weights>
Eigen::VectorXd interpolate(const DomainMesh<Dim>& mesh, const Weights& weights,
                            const Location<Dim>& place) {
  Eigen::VectorXd result = Eigen::VectorXd::Zero(num_control_points(weights));
  for (int k = 0; k <= Dim; ++k) {
    add_column(weights, mesh.cells(k, place.cell), place.coordinates[k], result);
  }
  return result;
}

#define FLBC_INSTANTIATE(Dim)                                                        \
  template WeightMatrix interpolate(const DomainMesh<Dim>&, const WeightMatrix&,     \
                                    const std::vector<Location<Dim>>&);              \
  template Eigen::VectorXd interpolate(const DomainMesh<Dim>&, const WeightMatrix&,  \
                                       const Location<Dim>&);                        \
  template Eigen::VectorXd interpolate(const DomainMesh<Dim>&, const SparseWeights&, \
                                       const Location<Dim>&);
FLBC_INSTANTIATE(2)
FLBC_INSTANTIATE(3)
#undef FLBC_INSTANTIATE

}  // namespace flbc

// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/interpolate.h"

#include "placement/place_checks.h"

namespace flbc {

template <int Dim>
SparseWeights interpolate(const DomainMesh<Dim>& mesh, const SparseWeights& weights,
                          const std::vector<Location<Dim>>& places) {
  return SparseWeights::of(weights.num_control_points(), static_cast<Index>(places.size()),
                           [&](Index p) { return interpolate(mesh, weights, places[p]); });
}

template <int Dim>
Eigen::VectorXd interpolate(const DomainMesh<Dim>& mesh, const SparseWeights& weights,
                            const Location<Dim>& place) {
  check_place(mesh, weights.num_points(), place);
  Eigen::VectorXd result = Eigen::VectorXd::Zero(weights.num_control_points());
  for (int k = 0; k <= Dim; ++k) {
    const double factor = place.coordinates[k];
    weights.visit(mesh.cells(k, place.cell),
                  [&](Index i, double weight) { result[i] += factor * weight; });
  }
  return result;
}

#define FLBC_INSTANTIATE(Dim)                                                        \
  template SparseWeights interpolate(const DomainMesh<Dim>&, const SparseWeights&,   \
                                     const std::vector<Location<Dim>>&);             \
  template Eigen::VectorXd interpolate(const DomainMesh<Dim>&, const SparseWeights&, \
                                       const Location<Dim>&);
FLBC_INSTANTIATE(2)
FLBC_INSTANTIATE(3)
#undef FLBC_INSTANTIATE

}  // namespace flbc

// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/interpolate.h"

namespace flbc {

template <int Dim>
WeightMatrix interpolate(const DomainMesh<Dim>& mesh, const WeightMatrix& weights,
                         const std::vector<Location<Dim>>& places) {
  const auto num_points = static_cast<Index>(places.size());
  WeightMatrix result(weights.rows(), num_points);
#pragma omp parallel for schedule(static)
  for (Index p = 0; p < num_points; ++p) {
    result.col(p).setZero();
    for (int k = 0; k <= Dim; ++k) {
      result.col(p) += places[p].coordinates[k] * weights.col(mesh.cells(k, places[p].cell));
    }
  }
  return result;
}

template WeightMatrix interpolate(const DomainMesh<2>&, const WeightMatrix&,
                                  const std::vector<Location<2>>&);
template WeightMatrix interpolate(const DomainMesh<3>&, const WeightMatrix&,
                                  const std::vector<Location<3>>&);

}  // namespace flbc

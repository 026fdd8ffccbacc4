// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/interpolate.h"

namespace flbc {

template <int Dim>
WeightMatrix interpolate(const DomainMesh<Dim>& mesh, const WeightMatrix& weights,
                         const std::vector<Location<Dim>>& places) {
  const auto num_points = static_cast<Index>(places.size());
  WeightMatrix result(weights.rows(), num_points);
#pragma omp parallel for schedule(static)
  for (Index p = 0; p < num_points; ++p) result.col(p) = interpolate(mesh, weights, places[p]);
  return result;
}

template <int Dim>
Eigen::VectorXd interpolate(const DomainMesh<Dim>& mesh, const WeightMatrix& weights,
                            const Location<Dim>& place) {
  Eigen::VectorXd result = Eigen::VectorXd::Zero(weights.rows());
  for (int k = 0; k <= Dim; ++k) {
    result += place.coordinates[k] * weights.col(mesh.cells(k, place.cell));
  }
  return result;
}

template <int Dim>
Eigen::VectorXd interpolate(const DomainMesh<Dim>& mesh, const SparseWeights& weights,
                            const Location<Dim>& place) {
  Eigen::VectorXd result = Eigen::VectorXd::Zero(weights.num_control_points());
  for (int k = 0; k <= Dim; ++k) {
    weights.visit(mesh.cells(k, place.cell),
                  [&](Index i, double weight) { result[i] += place.coordinates[k] * weight; });
  }
  return result;
}

template WeightMatrix interpolate(const DomainMesh<2>&, const WeightMatrix&,
                                  const std::vector<Location<2>>&);
template WeightMatrix interpolate(const DomainMesh<3>&, const WeightMatrix&,
                                  const std::vector<Location<3>>&);
template Eigen::VectorXd interpolate(const DomainMesh<2>&, const WeightMatrix&, const Location<2>&);
template Eigen::VectorXd interpolate(const DomainMesh<3>&, const WeightMatrix&, const Location<3>&);
template Eigen::VectorXd interpolate(const DomainMesh<2>&, const SparseWeights&,
                                     const Location<2>&);
template Eigen::VectorXd interpolate(const DomainMesh<3>&, const SparseWeights&,
                                     const Location<3>&);

}  // namespace flbc

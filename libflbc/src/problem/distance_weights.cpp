// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/distance_weights.h"

#include <cmath>

namespace flbc {
namespace {

double relative_to_weight(DistanceScheme scheme, double distance) {
  switch (scheme) {
    case DistanceScheme::kSquare:
      return distance * distance;
    case DistanceScheme::kLinear:
      return distance;
    case DistanceScheme::kSquareRoot:
      return std::sqrt(distance);
    case DistanceScheme::kConstant:
      break;
  }
  return 1;
}

}  // namespace

template <int Dim>
Eigen::MatrixXd distance_weights(DistanceScheme scheme, const Eigen::MatrixXd& distances,
                                 const DomainMesh<Dim>& mesh, Index num_control_points) {
  if (scheme == DistanceScheme::kConstant) {
    return Eigen::MatrixXd::Ones(num_control_points, mesh.num_cells());
  }
  const double scale = 1 / ((Dim + 1) * distances.maxCoeff());
  Eigen::MatrixXd weights(num_control_points, mesh.num_cells());
#pragma omp parallel for schedule(static)
  for (Index s = 0; s < mesh.num_cells(); ++s) {
    weights.col(s).setZero();
    for (int k = 0; k <= Dim; ++k) weights.col(s) += distances.col(mesh.cells(k, s));
    for (Index i = 0; i < num_control_points; ++i) {
      weights(i, s) = relative_to_weight(scheme, scale * weights(i, s));
    }
  }
  return weights;
}

template Eigen::MatrixXd distance_weights(DistanceScheme, const Eigen::MatrixXd&,
                                          const DomainMesh<2>&, Index);
template Eigen::MatrixXd distance_weights(DistanceScheme, const Eigen::MatrixXd&,
                                          const DomainMesh<3>&, Index);

}  // namespace flbc

// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/distance_weights.h"

#include <cmath>

#include "base/shape_checks.h"

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
WeightFunctions::WeightFunctions(DistanceScheme scheme, DistanceMatrix distances,
                                 const DomainMesh<Dim>& mesh, Index num_control_points)
    : distances_(std::move(distances)),
      cells_(mesh.cells),
      scheme_(scheme),
      num_control_points_(num_control_points) {
  if (scheme != DistanceScheme::kConstant) {
    check_size(distances_.rows(), distances_.cols(), num_control_points, mesh.num_vertices());
    check_indices(mesh.cells, mesh.num_vertices(), kMeshNames);
    scale_ = 1 / ((Dim + 1) * static_cast<double>(distances_.maxCoeff()));
  }
}

double WeightFunctions::from_distances(Eigen::Index i, Eigen::Index s) const {
  if (scheme_ == DistanceScheme::kConstant) return 1;
  double sum = 0;
  for (Eigen::Index k = 0; k < cells_.rows(); ++k) sum += distances_(i, cells_(k, s));
  return relative_to_weight(scheme_, scale_ * sum);
}

double WeightFunctions::from_mask(Eigen::Index row, Eigen::Index s) const {
  double sum = 0;
  for (Eigen::Index k = 0; k < cells_.rows(); ++k) sum += nearness_(row, cells_(k, s));
  const double mean = sum / static_cast<double>(cells_.rows());
  return largest_ * mean * mean;
}

Eigen::VectorXd WeightFunctions::col(Eigen::Index s) const {
  Eigen::VectorXd column(rows());
  for (Eigen::Index i = 0; i < column.size(); ++i) column[i] = (*this)(i, s);
  return column;
}

Eigen::MatrixXd WeightFunctions::dense() const {
  Eigen::MatrixXd matrix(rows(), cols());
  for (Eigen::Index s = 0; s < matrix.cols(); ++s) matrix.col(s) = col(s);
  return matrix;
}

template WeightFunctions::WeightFunctions(DistanceScheme, DistanceMatrix, const DomainMesh<2>&,
                                          Index);
template WeightFunctions::WeightFunctions(DistanceScheme, DistanceMatrix, const DomainMesh<3>&,
                                          Index);

}  // namespace flbc

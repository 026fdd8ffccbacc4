// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/cell_geometry.h"

#include <Eigen/LU>

#include "base/instantiate.h"
#include "base/parallel.h"

namespace flbc {

template <int Dim>
Eigen::Matrix<double, Dim, Dim> cell_edges(const DomainMesh<Dim>& mesh, Index cell) {
  Eigen::Matrix<double, Dim, Dim> edges;
  for (int k = 0; k < Dim; ++k) {
    edges.col(k) = mesh.points.col(mesh.cells(k + 1, cell)) - mesh.points.col(mesh.cells(0, cell));
  }
  return edges;
}

template <int Dim>
CellGeometry<Dim> cell_geometry(const DomainMesh<Dim>& mesh, Index cell) {
  const Eigen::Matrix<double, Dim, Dim> edges = cell_edges(mesh, cell);
  CellGeometry<Dim> geometry;
  geometry.measure = std::abs(edges.determinant()) / (Dim == 2 ? 2 : 6);
  geometry.hat_gradients.template rightCols<Dim>() = edges.inverse().transpose();
  geometry.hat_gradients.col(0) = -geometry.hat_gradients.template rightCols<Dim>().rowwise().sum();
  return geometry;
}

template <int Dim>
Eigen::VectorXd cell_measures(const DomainMesh<Dim>& mesh) {
  Eigen::VectorXd measures(mesh.num_cells());
  parallel_for(mesh.num_cells(), [&](Index s) { measures[s] = cell_geometry(mesh, s).measure; });
  return measures;
}

template <int Dim>
Eigen::Matrix<double, Eigen::Dynamic, Dim> weight_gradients(const DomainMesh<Dim>& mesh, Index cell,
                                                            const CellGeometry<Dim>& geometry,
                                                            const WeightMatrix& weights) {
  Eigen::Matrix<double, Eigen::Dynamic, Dim> gradients =
      weights.col(mesh.cells(0, cell)) * geometry.hat_gradients.col(0).transpose();
  for (int k = 1; k <= Dim; ++k) {
    gradients += weights.col(mesh.cells(k, cell)) * geometry.hat_gradients.col(k).transpose();
  }
  return gradients;
}

FLBC_INSTANTIATE_FUNCTION(cell_edges)
FLBC_INSTANTIATE_FUNCTION(cell_geometry)
FLBC_INSTANTIATE_FUNCTION(cell_measures)
FLBC_INSTANTIATE_FUNCTION(weight_gradients)

}  // namespace flbc

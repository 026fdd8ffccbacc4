// SPDX-License-Identifier: BSD-3-Clause
// Geometry of one cell, for the finite-element parts of the library.
#pragma once

#include <algorithm>

#include "flbc/domain_mesh.h"

namespace flbc {

//! Measure of a cell and the gradients of its Dim + 1 hat functions (columns).
template <int Dim>
struct CellGeometry {
  double measure;
  Eigen::Matrix<double, Dim, Dim + 1> hat_gradients;
};

//! The edges of a cell from its first corner to the others.
template <int Dim>
Eigen::Matrix<double, Dim, Dim> cell_edges(const DomainMesh<Dim>& mesh, Index cell);

template <int Dim>
CellGeometry<Dim> cell_geometry(const DomainMesh<Dim>& mesh, Index cell);

//! Distance of a point outside the facets of a cell.
//! \param coordinates  barycentric coordinates of the point \param hat_gradients  of the cell
template <int Dim>
double distance_beyond(const Vector<Dim + 1>& coordinates,
                       const Eigen::Matrix<double, Dim, Dim + 1>& hat_gradients) {
  double distance = 0;
  for (int k = 0; k <= Dim; ++k) {
    if (coordinates[k] >= 0) continue;
    // Multiplied by the height over the facet, which is 1 / |gradient|.
    distance = std::max(distance, -coordinates[k] / hat_gradients.col(k).norm());
  }
  return distance;
}

//! Measures of all cells.
template <int Dim>
Eigen::VectorXd cell_measures(const DomainMesh<Dim>& mesh);

//! The centroid of a cell or facet.
//! \param points  Dim x V
//! \param simplices  the corners of each, one simplex per column
template <int Dim, class Simplices>
Vector<Dim> centroid(const PointList<Dim>& points, const Simplices& simplices,
                     Eigen::Index simplex) {
  Vector<Dim> sum = Vector<Dim>::Zero();
  for (Eigen::Index k = 0; k < simplices.rows(); ++k) sum += points.col(simplices(k, simplex));
  return sum / static_cast<double>(simplices.rows());
}

//! All centroids, one simplex per column. Parameters as above.
template <int Dim, class Simplices>
PointList<Dim> centroids(const PointList<Dim>& points, const Simplices& simplices) {
  PointList<Dim> result(Dim, simplices.cols());
  for (Eigen::Index s = 0; s < simplices.cols(); ++s) {
    result.col(s) = centroid(points, simplices, s);
  }
  return result;
}

//! Gradients of piecewise linear weights on one cell, n x Dim. \param weights  n x V
template <int Dim>
Eigen::Matrix<double, Eigen::Dynamic, Dim> weight_gradients(const DomainMesh<Dim>& mesh, Index cell,
                                                            const CellGeometry<Dim>& geometry,
                                                            const WeightMatrix& weights);

}  // namespace flbc

// SPDX-License-Identifier: BSD-3-Clause
// The dual of boundary cells, whose corners all lie on the boundary, where weights are known.
#pragma once

#include "flbc/lbc_problem.h"
#include "mesh/cell_geometry.h"

namespace flbc {

//! Whether all corners of a cell lie on the boundary.
template <int Dim>
bool is_boundary_cell(const LbcProblem<Dim>& problem, Index cell) {
  for (const Index v : problem.mesh.cells.col(cell)) {
    if (problem.boundary.is_interior(v)) return false;
  }
  return true;
}

//! p / A = (phi / |grad w| + epsilon) grad w, n x Dim, of a boundary cell: the best dual for its
//! weights.
template <int Dim>
Eigen::Matrix<double, Eigen::Dynamic, Dim> boundary_flux_density(const LbcProblem<Dim>& problem,
                                                                 Index cell) {
  const auto geometry = cell_geometry(problem.mesh, cell);
  Eigen::MatrixXd corners = Eigen::MatrixXd::Zero(problem.num_control_points(), Dim + 1);
  for (int k = 0; k <= Dim; ++k) {
    problem.boundary.scatter(problem.boundary.boundary_index[problem.mesh.cells(k, cell)],
                             corners.col(k));
  }
  Eigen::Matrix<double, Eigen::Dynamic, Dim> density = corners * geometry.hat_gradients.transpose();
  for (Index i = 0; i < problem.num_control_points(); ++i) {
    const double length = density.row(i).norm();
    if (length > 0) density.row(i) *= problem.phi(i, cell) / length + problem.smoothness;
  }
  return density;
}

}  // namespace flbc

// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Feasible weights that are easy to get: a start for solvers and something sound to break.
#pragma once

#include "support/test.h"

namespace flbc::testing {

//! Discrete harmonic coordinates by dense elimination, n x V. Linear functions are discretely
//! harmonic, so on any mesh they have the paper's properties 1, 2, 4 and 5 up to rounding.
template <int Dim>
Eigen::MatrixXd harmonic_weights(const Sample<Dim>& sample) {
  const auto& mesh = sample.mesh;
  Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(mesh.num_vertices(), mesh.num_vertices());
  for (Index s = 0; s < mesh.num_cells(); ++s) {
    const auto corners = cell_corners(mesh, s);
    const Eigen::MatrixXd hats =
        linear_gradients<Dim>(corners, Eigen::MatrixXd::Identity(Dim + 1, Dim + 1));
    const Eigen::MatrixXd local = simplex_measure<Dim>(corners) * hats.transpose() * hats;
    for (int a = 0; a <= Dim; ++a) {
      for (int b = 0; b <= Dim; ++b) stiffness(mesh.cells(a, s), mesh.cells(b, s)) += local(a, b);
    }
  }
  Eigen::MatrixXd right = Eigen::MatrixXd::Zero(mesh.num_vertices(), sample.cage.size());
  const Eigen::MatrixXd boundary = demanded_boundary_weights(sample.cage, mesh);
  const auto interior = interior_vertices(mesh);
  for (Index v = 0; v < mesh.num_vertices(); ++v) {
    if (interior[v]) continue;
    stiffness.row(v).setZero();
    stiffness(v, v) = 1;
    right.row(v) = boundary.col(v).transpose();
  }
  return solve_square(stiffness, right).transpose();
}

}  // namespace flbc::testing

// SPDX-License-Identifier: BSD-3-Clause
// The finite-element Laplacian of a domain mesh and the Poisson problem with boundary values.
#pragma once

#include <optional>
#include <variant>
#include <vector>

#include "flbc/boundary_values.h"
#include "flbc/domain_mesh.h"
#include "flbc/types.h"
#include "linear/linear_solver.h"
#include "linear/multigrid_cg.h"
#include "linear/panel_cholesky.h"

namespace flbc {

//! Sum over cells of m_s grad(lambda_v) . grad(lambda_w), symmetric.
//! \param cell_factors  m, one per cell
//! \param vertices  vertices v and w with a row and column, ascending
template <int Dim>
RowMatrix stiffness_matrix(const DomainMesh<Dim>& mesh, const Eigen::VectorXd& cell_factors,
                           const std::vector<Index>& vertices);

//! The same with the measure of each cell and all vertices: the stiffness matrix, V x V.
template <int Dim>
RowMatrix stiffness_matrix(const DomainMesh<Dim>& mesh);

//! Lumped mass per vertex: its share of the measure of the cells around it.
template <int Dim>
Eigen::VectorXd lumped_mass(const DomainMesh<Dim>& mesh);

//! The known boundary weights as a matrix, n x B.
template <int Dim>
Eigen::MatrixXd boundary_matrix(const BoundaryValues<Dim>& boundary, Index n);

//! The Poisson problem on the interior vertices for many functions with given boundary values.
//! Factored once, or solved by multigrid in time and memory linear in V.
template <int Dim>
class DirichletProblem {
 public:
  //! \param solver  kDirect, or any other for multigrid
  DirichletProblem(const DomainMesh<Dim>& mesh, const BoundaryValues<Dim>& boundary,
                   LinearSolver solver = LinearSolver::kDirect);

  //! Minimizes sum_s A_s |grad w_i - g_i|^2 for every i.
  //! \param boundary_values  k x B, known values, one row per function
  //! \param divergence  k x V, the right-hand side sum_s A_s grad(lambda_v) . g_i(s); empty means
  //! zero, which gives harmonic functions
  //! \return k x V, including boundary values. Called by one thread at a time
  WeightMatrix solve(const Eigen::MatrixXd& boundary_values,
                     const Eigen::MatrixXd& divergence = {}) const;

 private:
  std::vector<Index> interior_;  // interior vertices, ascending
  std::vector<Index> boundary_;  // boundary vertices, ascending
  RowMatrix coupling_;           // interior x boundary part of K
  using InteriorSolver = std::variant<PanelCholesky<double>, MultigridCg>;
  std::optional<InteriorSolver> interior_solver_;  // interior x interior part
};

}  // namespace flbc

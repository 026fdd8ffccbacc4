// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! The paper's solver (sections 4.2.1 and 4.2.3) word for word: every auxiliary and dual variable
//! is a matrix of its own. Slow and large; it is the reference for the solver of the library, with
//! which it shares no code.
//!
//! Problem (7)-(10) fixes slopes only: where the domain's boundary is not connected (a hole in 2D,
//! a cavity in 3D) it is a relaxation, whose gradients may integrate to weights that miss the
//! boundary values by a constant per boundary component.
#pragma once

#include <vector>

#include "flbc/domain_mesh.h"
#include "support/simplex.h"

namespace flbc::testing {

//! Data of the textbook solver. The points are taken as they are, without scaling.
template <int Dim>
struct TextbookInput {
  PointList<Dim> control_points;                  //!< Dim x n, not all in one hyperplane
  DomainMesh<Dim> mesh;                           //!< V vertices, F cells
  Eigen::MatrixXd phi;                            //!< n x F, per control point and cell, >= 0
  Eigen::MatrixXd boundary_weights;               //!< n x V, read at boundary vertices only
  double penalty = 1;                             //!< mu > 0
  double smoothness = 0;                          //!< epsilon >= 0, a length
  std::vector<PointList<Dim>> initial_gradients;  //!< F blocks, Dim x n; need not be feasible
};

//! The three steps of the paper's ADMM. The duals start at zero; Z, X and Y first exist after the
//! first iteration.
template <int Dim>
class TextbookAdmm {
 public:
  using Block = PointList<Dim>;  //!< Dim x n, the gradients of w_1 .. w_n

  //! \throws std::invalid_argument if sizes do not fit, the penalty is not positive or the control
  //! points lie in a hyperplane.
  explicit TextbookAdmm(TextbookInput<Dim> input);

  //! Steps 1 (X, Y, Z), 2 (G) and 3 (duals).
  void iterate();

  Block gradient(Index cell) const;              //!< g_s
  double primal_residual_norm() const;           //!< |[X - G S_X; Y - G S_Y; Z - G]|
  double dual_residual_norm() const;             //!< |mu [dG S_X; dG S_Y; dG]|, dG = change of G
  Eigen::Index num_residual_components() const;  //!< N_p = N_d

 private:
  void find_facets();
  void solve_local_system();
  void update_x();
  void update_y();
  void update_z();
  void update_g();
  void update_duals();

  TextbookInput<Dim> input_;
  Eigen::Index n_;                                  // control points
  std::vector<FacetKey<Dim>> boundary_, interior_;  // m_b and m_e facets
  std::vector<Index> x_cells_;                      // S_X: the cell of each copy in X, m_b
  std::vector<Index> y_cells_;                      // S_Y: the cell of each copy in Y, 2 m_e
  std::vector<Block> h_;                            // m_b
  std::vector<double> measures_;                    // A_s
  Block least_norm_;                                // g~, Dim x n
  Eigen::MatrixXd K_;                               // n x n
  // Rows: Dim per cell or copy; columns: control points.
  Eigen::MatrixXd G_, previous_G_, Z_, X_, Y_, lambda_Z_, lambda_X_, lambda_Y_;
};

extern template class TextbookAdmm<2>;
extern template class TextbookAdmm<3>;

}  // namespace flbc::testing

// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! The original solver, problem (2) of the paper, word for word: W, Z, Y, a dual for each
//! constraint, a null-space matrix M, dense matrices. Slow and large; it exists to judge the
//! library's splitting, with which it shares no code.
#pragma once

#include <vector>

#include <Eigen/Cholesky>

#include "flbc/domain_mesh.h"

namespace flbc::testing {

//! Data of the solver. The points are taken as they are, without scaling.
template <int Dim>
struct Lbc2014Input {
  PointList<Dim> control_points;     //!< Dim x n
  DomainMesh<Dim> mesh;              //!< V vertices, F cells
  Eigen::MatrixXd phi;               //!< n x F
  Eigen::MatrixXd initial_weights;   //!< n x V; boundary columns are kept
  std::vector<Index> interior;       //!< vertices whose weights are sought, ascending
  Eigen::VectorXd cell_metric;       //!< weight of |Z - grad w|^2 per cell, F
  Eigen::VectorXd vertex_metric;     //!< weight of |W - w|^2 per vertex, V; empty: no W
  double penalty = 1;                //!< mu > 0
  double relaxation = 1;             //!< in (0, 2)
  double smoothness = 0;             //!< epsilon >= 0, a length
  Eigen::MatrixXd initial_z_dual{};  //!< scaled dual of Z, n x Dim F (a block per cell)
};

//! With the quadratic term epsilon / 2 A |grad w|^2. Alternates 1. W and Z, 2. Y, 3. duals, with
//! over-relaxation of W and Z in steps 2 and 3.
template <int Dim>
class TextbookLbc2014 {
 public:
  explicit TextbookLbc2014(Lbc2014Input<Dim> input);

  void iterate();

  //! Y M + H, with the boundary values, n x V.
  Eigen::MatrixXd weights() const;
  //! Norms of [sqrt(metric) (Z - grad w); sqrt(metric) (W - w)] and of mu times the change of
  //! [sqrt(metric) grad w; sqrt(metric) w] in the last iteration.
  double primal_residual_norm() const { return primal_residual_; }
  //! The parts of the first one, squared: of one cell, and of W = w at all vertices.
  double squared_violation_of_cell(Index cell) const {
    return (z_metric_.asDiagonal() * violation_z_.cwiseAbs2()).middleRows(Dim * cell, Dim).sum();
  }
  double squared_violation_of_weights() const {
    return (w_metric_.asDiagonal() * violation_w_.cwiseAbs2()).sum();
  }
  double dual_residual_norm() const { return dual_residual_; }

 private:
  Eigen::MatrixXd gradients(const Eigen::MatrixXd& interior_weights) const;

  Lbc2014Input<Dim> input_;
  Eigen::MatrixXd G_;         // (Dim F) x m: gradients of interior weights
  Eigen::MatrixXd E_;         // (Dim F) x n: gradients of the boundary's share
  Eigen::MatrixXd M_;         // (n - Dim - 1) x n: orthonormal basis of the null space
  Eigen::MatrixXd H_;         // m x n: a solution of the linear constraints
  Eigen::VectorXd z_metric_;  // Dim F
  Eigen::VectorXd w_metric_;  // m, zero without W
  Eigen::LDLT<Eigen::MatrixXd> system_;
  Eigen::MatrixXd Y_, Z_, W_, dual_z_, dual_w_, violation_z_, violation_w_;
  double primal_residual_ = 0;
  double dual_residual_ = 0;
};

extern template class TextbookLbc2014<2>;
extern template class TextbookLbc2014<3>;

}  // namespace flbc::testing

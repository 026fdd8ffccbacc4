// SPDX-License-Identifier: BSD-3-Clause
// The dual of the projection on {w >= 0, Q^T w = b}: a smooth convex function of Dim + 1 unknowns.
#pragma once

#include <vector>

#include "flbc/types.h"

namespace flbc {

//! Semismooth Newton for the nearest w >= 0 to a row y with Q^T w = b. By duality
//! w = max(0, y + Q mu), where mu minimizes
//!
//!     F(mu) = |max(0, y + Q mu)|^2 / 2 - b . mu + delta |mu|^2 / 2
//!
//! with delta = 0. F is convex and piecewise quadratic. With delta > 0 it has a unique minimum,
//! which Newton steps with exact line search reach in finitely many steps for any Q. Since Q^T w is
//! given, y + Q mu has the same projection as y. Restarting from there is the method of multipliers
//! and removes the effect of delta. Not thread-safe, because it keeps its buffers.
template <int Dim>
class DualNewton {
 public:
  using Basis = Eigen::Matrix<double, Eigen::Dynamic, Dim + 1>;
  using Sums = Eigen::Matrix<double, Dim + 1, 1>;

  //! \param basis  Q, n x (Dim + 1), kept by reference
  explicit DualNewton(const Basis& basis) : basis_(basis) {}

  //! Minimizes F. \param row  y, n \param sums  b \return true if the minimum was reached
  bool minimize(const Eigen::VectorXd& row, const Sums& sums, double delta);

  //! y + Q mu at the last mu, n.
  const Eigen::VectorXd& row() const { return row_; }

 private:
  void evaluate(const Eigen::VectorXd& row, const Sums& sums, double delta);
  Sums newton_direction(double delta) const;
  double step_length(const Sums& direction, const Sums& sums, double delta);

  const Basis& basis_;
  Eigen::VectorXd row_;
  Eigen::VectorXd change_;
  Sums mu_;
  Sums gradient_;
  Eigen::Matrix<double, Dim + 1, Dim + 1> hessian_;
  std::vector<Index> active_, active_before_;  // where row_ > 0
};

}  // namespace flbc

// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! The nearest weights on few control points, in any metric, if they may be negative.
#pragma once

#include <vector>

#include <Eigen/Cholesky>

#include "flbc/types.h"

namespace flbc {

//! Minimises (w - t) . H (w - t) over the w with sum w = 1, sum w c = x and w = 0 outside of a
//! support, for one point x and target t at a time. Keeps its buffers: one per thread.
template <int Dim>
class FreeRow {
 public:
  using Sums = Eigen::Matrix<double, Dim + 1, 1>;

  //! \param metric  H, n x n, positive definite, kept by reference
  //! \param control_points  Dim x n, kept by reference \param size  a length to measure them by
  FreeRow(const Eigen::MatrixXd& metric, const PointList<Dim>& control_points, double size);

  //! From here on for this point. \return H t, n, to be filled in
  Eigen::VectorXd& aim_at(const Vector<Dim>& point);

  const Eigen::MatrixXd& metric() const { return metric_; }
  const Eigen::VectorXd& pull() const { return pull_; }

  //! (1, (c - x) / size): what a weight of 1 adds to the sums, which must become (1, 0, ..).
  Sums constraint(Index control_point) const;

  //! \return false if rounding hides the minimum. Where the sums cannot be met they are not: this
  //! is for the caller to check
  bool minimize(const std::vector<Index>& support);

  //! The minimum, in the order of the support, until the next one.
  const std::vector<double>& weights() const { return weights_; }

  //! (w - t) . H (w - t) - t . H t at the minimum.
  double cost() const { return cost_; }

  //! m such that H (w - t) = A m on the support, A the constraints as rows.
  const Sums& multipliers() const { return multipliers_; }

  //! A m for all control points, n.
  Eigen::VectorXd absorbed() const;

  //! By how much the least cost rises when a weight must be 0, divided by its square.
  //! \param costs  replaced, in the order of the support
  void removal_costs(std::vector<double>& costs);

 private:
  using Sides = Eigen::Matrix<double, Dim + 2, 1>;
  using Square = Eigen::Matrix<double, Dim + 1, Dim + 1>;

  bool factor(const std::vector<Index>& support);

  const Eigen::MatrixXd& metric_;
  const PointList<Dim>& control_points_;
  double size_;
  Vector<Dim> point_;
  Eigen::VectorXd pull_;  // H t

  // With H = L L^T on the support,
  std::vector<double> factor_;  // L, row by row
  std::vector<Sides> sides_;    // L^-1 [A, H t]
  Eigen::LLT<Square> gram_;     // A^T H^-1 A
  Sums multipliers_;
  std::vector<double> weights_;
  double cost_ = 0;
  std::vector<double> column_;
};

}  // namespace flbc

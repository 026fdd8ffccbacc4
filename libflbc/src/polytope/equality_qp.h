// SPDX-License-Identifier: BSD-3-Clause
// Equality-constrained quadratic program for the weights of one point, and its metric.
#pragma once

#include <vector>

#include "flbc/types.h"

namespace flbc {

//! The symmetric, positive definite H of the squared distance d . H d between weights.
class Metric {
 public:
  //! The identity, which needs no factorization.
  Metric() = default;

  //! \param matrix  H, n x n, kept by reference
  explicit Metric(const Eigen::MatrixXd& matrix) : matrix_(&matrix) {}

  bool is_identity() const { return matrix_ == nullptr; }

  double operator()(Index i, Index j) const {
    if (matrix_ == nullptr) return i == j ? 1 : 0;
    return (*matrix_)(i, j);
  }

  //! Adds H e_i times a factor.
  //! \param sum  n
  void add_column(Index i, double factor, Eigen::VectorXd& sum) const {
    if (matrix_ == nullptr) {
      sum[i] += factor;
    } else {
      sum += factor * matrix_->col(i);
    }
  }

 private:
  const Eigen::MatrixXd* matrix_ = nullptr;
};

//! Minimizes (w - t) . H (w - t) over the w with sum w = 1, sum w c = x and w = 0 outside a
//! support, for one point x and target t at a time. Not thread-safe, because it keeps its buffers.
template <int Dim>
class EqualityQp {
 public:
  using Sums = Eigen::Matrix<double, Dim + 1, 1>;

  //! \param metric  H, n x n
  //! \param control_points  Dim x n, kept by reference
  EqualityQp(Metric metric, const PointList<Dim>& control_points);

  //! Sets the current point.
  //! \return H t, n, to be filled by the caller
  Eigen::VectorXd& aim_at(const Vector<Dim>& point);

  const Metric& metric() const { return metric_; }

  //! H t, n.
  const Eigen::VectorXd& pull() const { return pull_; }

  //! (1, (c - x) / size): the contribution of a unit weight to the constraints, whose sum must be
  //! (1, 0, ..). The size is that of the control points.
  Sums constraint(Index control_point) const { return constraints_.col(control_point); }

  //! Free if the support is unchanged.
  //! \return false if rounding hides the minimum. The caller must check whether the constraints are
  //! met
  bool minimize(const std::vector<Index>& support);

  //! The minimum, in the order of the support; valid until the next minimization.
  const std::vector<double>& weights() const { return weights_; }

  //! (w - t) . H (w - t) - t . H t at the minimum.
  double cost() const { return cost_; }

  //! m such that H (w - t) = A m on the support, A the constraints as rows.
  const Sums& multipliers() const { return multipliers_; }

  //! A m for all control points, n.
  Eigen::VectorXd constraint_forces() const { return constraints_.transpose() * multipliers_; }

  //! Half the second derivative of the minimum cost with respect to the weight of a control point
  //! outside the support.
  double curvature(Index newcomer);

  //! Increase of the minimum cost if a weight is fixed at 0, divided by its square.
  //! \param costs  replaced, in the order of the support
  void removal_costs(std::vector<double>& costs);

 private:
  using Square = Eigen::Matrix<double, Dim + 1, Dim + 1>;

  bool factor_metric();
  void factor_gram();
  void orthonormalize(Sums& constraint) const;

  Metric metric_;
  const PointList<Dim>& control_points_;
  double scale_;
  Eigen::Matrix<double, Dim + 1, Eigen::Dynamic> constraints_;  // A^T
  Eigen::VectorXd pull_;                                        // H t

  // With H = L L^T on the support,
  std::vector<Index> support_;
  bool minimized_ = false;       // whether all of this belongs to the current support
  std::vector<double> factor_;   // L by rows, diagonal inverted; unused if H is the identity
  std::vector<Sums> rows_;       // L^-1 A G^-T
  std::vector<double> targets_;  // L^-1 H t
  Square gram_;                  // G, lower triangular, diagonal inverted, with G G^T = A^T H^-1 A
  Sums multipliers_;
  std::vector<double> weights_;
  double cost_ = 0;
  std::vector<double> column_;
};

}  // namespace flbc

// SPDX-License-Identifier: BSD-3-Clause
// The part of the equality-constrained quadratic program that depends on the support alone.
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

 private:
  const Eigen::MatrixXd* matrix_ = nullptr;
};

//! Factors of H and of the constraints on a support. Many points share a support, so callers keep
//! them. With H = L L^T, the constraints are orthonormal after L^-1 and G^-1.
template <int Dim>
class SupportFactor {
 public:
  using Sums = Eigen::Matrix<double, Dim + 1, 1>;

  const std::vector<Index>& support() const { return support_; }

  //! \param control_points  Dim x n \param inverse_scale  of the constraints
  //! \return false, with an empty support, if rounding hides the factors
  bool compute(Metric metric, const PointList<Dim>& control_points, double inverse_scale,
               const std::vector<Index>& support);

  //! The center of the constraints (1, (c - center) / scale): the mean of the support.
  const Vector<Dim>& center() const { return center_; }

  //! L^-1 A G^-T, a row for each control point.
  const std::vector<Sums>& rows() const { return rows_; }

  //! L^-1 b in place of b. \param values  as many as the support
  void solve_lower(double* values) const;

  //! L^-T b in place of b. \param values  as many as the support
  void solve_upper(double* values) const;

  //! G^-1 a in place of a.
  void orthonormalize(Sums& constraint) const;

  //! G^-T m in place of m.
  void solve_multipliers(Sums& multipliers) const;

  //! The diagonal of Z = H^-1 - H^-1 A (A^T H^-1 A)^-1 A^T H^-1, inverted.
  const std::vector<double>& stiffnesses();

 private:
  bool factor_metric(Metric metric);
  void factor_gram();

  std::vector<Index> support_;
  Vector<Dim> center_;
  std::vector<double> lower_;  // L by columns, diagonal inverted; empty if H is the identity
  std::vector<Sums> rows_;
  Eigen::Matrix<double, Dim + 1, Dim + 1> gram_;  // G, diagonal inverted, G G^T = A^T H^-1 A
  std::vector<double> stiffnesses_;               // empty until needed
};

}  // namespace flbc

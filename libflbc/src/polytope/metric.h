// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! The metric in which sparse weights are nearest to those given.
#pragma once

#include "flbc/types.h"

namespace flbc {

//! The symmetric, positive definite H of the squared distance d . H d between weights.
class Metric {
 public:
  //! The identity, which saves every factorisation.
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

}  // namespace flbc

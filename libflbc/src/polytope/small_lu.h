// SPDX-License-Identifier: BSD-3-Clause
// Small systems of equations. Eigen would compile ten times longer.
#pragma once

#include <cmath>
#include <utility>

#include <Eigen/Core>

namespace flbc {

//! P A = L U with partial pivoting, of a matrix of at most 4 x 4.
template <int N>
class SmallLu {
 public:
  using Column = Eigen::Matrix<double, N, 1>;
  using Square = Eigen::Matrix<double, N, N>;

  //! A singular matrix makes solutions infinite or NaN.
  void compute(const Square& matrix) {
    lu_ = matrix;
    for (int k = 0; k < N; ++k) {
      int pivot = k;
      for (int row = k + 1; row < N; ++row) {
        if (std::abs(lu_(row, k)) > std::abs(lu_(pivot, k))) pivot = row;
      }
      pivots_[k] = pivot;
      for (int column = 0; column < N; ++column) std::swap(lu_(k, column), lu_(pivot, column));
      for (int row = k + 1; row < N; ++row) {
        lu_(row, k) /= lu_(k, k);
        for (int column = k + 1; column < N; ++column) {
          lu_(row, column) -= lu_(row, k) * lu_(k, column);
        }
      }
    }
  }

  //! A^-1 b
  Column solve(Column b) const {
    for (int k = 0; k < N; ++k) std::swap(b[k], b[pivots_[k]]);
    for (int row = 1; row < N; ++row) {
      for (int k = 0; k < row; ++k) b[row] -= lu_(row, k) * b[k];
    }
    for (int row = N - 1; row >= 0; --row) {
      for (int k = row + 1; k < N; ++k) b[row] -= lu_(row, k) * b[k];
      b[row] /= lu_(row, row);
    }
    return b;
  }

  //! A^-T b
  Column solve_transposed(Column b) const {
    for (int row = 0; row < N; ++row) {
      for (int k = 0; k < row; ++k) b[row] -= lu_(k, row) * b[k];
      b[row] /= lu_(row, row);
    }
    for (int row = N - 2; row >= 0; --row) {
      for (int k = row + 1; k < N; ++k) b[row] -= lu_(k, row) * b[k];
    }
    for (int k = N - 1; k >= 0; --k) std::swap(b[k], b[pivots_[k]]);
    return b;
  }

 private:
  Square lu_;
  int pivots_[N];
};

}  // namespace flbc

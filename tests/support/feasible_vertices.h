// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! All basic feasible solutions of one row of weights, by trying every basis: what sums up the set
//! of feasible weights of a point for few control points.
#pragma once

#include "flbc/types.h"
#include "support/test.h"

namespace flbc::testing {

//! The vertices of {w >= -tolerance, sum w = 1, sum w c = x}, each n. \param tolerance  also of
//! the determinant of a basis, for control points of size about 1
template <int Dim>
std::vector<Eigen::VectorXd> feasible_vertices(const PointList<Dim>& control_points,
                                               const Vector<Dim>& point, double tolerance) {
  using Square = Eigen::Matrix<double, Dim + 1, Dim + 1>;
  const auto n = static_cast<int>(control_points.cols());
  std::vector<Eigen::VectorXd> vertices;
  std::vector<int> basis(Dim + 1);
  for (int subset = 0; subset < (1 << n); ++subset) {
    basis.clear();
    for (int i = 0; i < n; ++i) {
      if ((subset >> i) & 1) basis.push_back(i);
    }
    if (basis.size() != Dim + 1) continue;
    Square matrix;
    matrix.row(0).setOnes();
    matrix.template bottomRows<Dim>() = (control_points(Eigen::all, basis).colwise() - point);
    if (std::abs(matrix.determinant()) < tolerance) continue;
    const Eigen::VectorXd weights = matrix.inverse().col(0);
    if (weights.minCoeff() < -tolerance) continue;
    vertices.push_back(Eigen::VectorXd::Zero(n));
    vertices.back()(basis) = weights;
  }
  return vertices;
}

//! Numbers for tests, the same on every machine.
class Numbers {
 public:
  explicit Numbers(unsigned seed) : engine_(seed) {}
  double uniform(double low, double high) {
    return low + (high - low) * (static_cast<double>(engine_()) / 4294967296.0);
  }
  int below(int count) { return static_cast<int>(engine_() % static_cast<unsigned>(count)); }
  Eigen::MatrixXd matrix(Eigen::Index rows, Eigen::Index columns, double low, double high) {
    Eigen::MatrixXd numbers(rows, columns);
    for (double& number : numbers.reshaped()) number = uniform(low, high);
    return numbers;
  }
  //! n non-negative numbers with sum 1.
  Eigen::VectorXd convex(Eigen::Index n) {
    const Eigen::VectorXd weights = matrix(n, 1, 1e-6, 1).array().log().abs();
    return weights / weights.sum();
  }

 private:
  std::mt19937 engine_;
};

}  // namespace flbc::testing

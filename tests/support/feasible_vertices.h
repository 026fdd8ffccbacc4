// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Control points and points that could need special care, and all basic feasible solutions of one
//! row of weights, by trying every basis: what sums up the set of feasible weights of a point for
//! few control points.
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

//! The lattice points of a box with `side` points a side, inner ones left out: many in each facet,
//! many on each edge.
template <int Dim>
PointList<Dim> lattice(int side) {
  PointList<Dim> points(Dim, 0);
  for (int k = 0; k < std::pow(side, Dim); ++k) {
    Vector<Dim> point;
    bool outer = false;
    for (int d = 0, rest = k; d < Dim; ++d, rest /= side) {
      point[d] = rest % side;
      outer |= rest % side == 0 || rest % side == side - 1;
    }
    if (!outer) continue;
    points.conservativeResize(Dim, points.cols() + 1);
    points.col(points.cols() - 1) = point / (side - 1);
  }
  return points;
}

//! Control points of every kind that could need special care, with names for failing tests.
template <int Dim>
std::vector<std::pair<std::string, PointList<Dim>>> awkward_control_points() {
  Numbers numbers(3);
  const PointList<Dim> box = lattice<Dim>(4);
  PointList<Dim> twice(Dim, 2 * box.cols());
  twice << box, box;
  PointList<Dim> nearly_twice = twice;
  nearly_twice.rightCols(box.cols()).array() += 1e-9;
  PointList<Dim> flat = box;
  flat.row(0) *= 1e-6;
  PointList<Dim> in_plane = box;
  in_plane.row(0).setConstant(0.5);
  PointList<Dim> in_line = box;
  in_line.topRows(Dim - 1).setConstant(0.5);
  return {{"simplex", numbers.matrix(Dim, Dim + 1, -1, 1)},
          {"few", numbers.matrix(Dim, 7, -1, 1)},
          {"many", numbers.matrix(Dim, 250, -1, 1)},
          {"box", box},
          {"rough box", box + numbers.matrix(Dim, box.cols(), -1e-5, 1e-5)},
          {"smooth box", box + numbers.matrix(Dim, box.cols(), -1e-12, 1e-12)},
          {"twice", twice},
          {"nearly twice", nearly_twice},
          {"flat", flat},
          {"in a plane", in_plane},
          {"in a line", in_line},
          {"far", (box.array() + 1e3).matrix()},
          {"large", 1e25 * box},
          {"small", 1e-25 * box}};
}

//! Points inside, in facets and edges of the hull, at control points and next to the hull.
template <int Dim>
PointList<Dim> awkward_points(const PointList<Dim>& control_points, Numbers& numbers, int count) {
  const auto n = static_cast<int>(control_points.cols());
  const double size = bounding_box_diagonal<Dim>(control_points);
  PointList<Dim> points(Dim, count);
  for (int k = 0; k < count; ++k) {
    Eigen::VectorXd weights = Eigen::VectorXd::Zero(n);
    Vector<Dim> aside = Vector<Dim>::Zero();
    if (k % 4 == 0) weights = numbers.convex(n);
    if (k % 4 == 1) weights[numbers.below(n)] = 1;
    if (k % 4 == 2) weights(std::vector<int>{numbers.below(n), numbers.below(n)}).setConstant(0.5);
    if (k % 4 == 3) {
      // On the side of the hull where one coordinate is largest, or 1e-15 of the size outside it.
      const int axis = numbers.below(Dim);
      const double largest = control_points.row(axis).maxCoeff();
      const Eigen::VectorXd mixture = numbers.convex(n);
      for (int i = 0; i < n; ++i) {
        if (control_points(axis, i) >= largest - 1e-7 * size) weights[i] = mixture[i];
      }
      aside[axis] = numbers.uniform(-1e-15, 1e-15) * size;
    }
    points.col(k) = control_points * (weights / weights.sum()) + aside;
  }
  return points;
}

}  // namespace flbc::testing

// SPDX-License-Identifier: BSD-3-Clause
// The quadric error of Garland and Heckbert ("Surface simplification using quadric error metrics",
// 1997): squared distances from the planes of a surface.
#pragma once

#include <Eigen/LU>

#include "caging/mirror_plane.h"
#include "flbc/types.h"

namespace flbc {

//! x^T matrix x - 2 linear^T x + constant
template <int Dim>
struct Quadric {
  Eigen::Matrix<double, Dim, Dim> matrix = Eigen::Matrix<double, Dim, Dim>::Zero();
  Vector<Dim> linear = Vector<Dim>::Zero();
  double constant = 0;

  //! Adds weight * (squared distance from a plane). \param normal  of length 1
  void add_plane(const Vector<Dim>& normal, const Vector<Dim>& point, double weight) {
    const double height = normal.dot(point);
    matrix += weight * normal * normal.transpose();
    linear += weight * height * normal;
    constant += weight * height * height;
  }

  //! Adds weight * (squared distance from a point).
  void add_point(const Vector<Dim>& point, double weight) {
    matrix.diagonal().array() += weight;
    linear += weight * point;
    constant += weight * point.squaredNorm();
  }

  Quadric& operator+=(const Quadric& other) {
    matrix += other.matrix;
    linear += other.linear;
    constant += other.constant;
    return *this;
  }

  double operator()(const Vector<Dim>& x) const {
    return x.dot(matrix * x) - 2 * linear.dot(x) + constant;
  }

  //! Where it is least; some point has been added, so that there is one such place.
  Vector<Dim> minimiser() const { return matrix.inverse() * linear; }

  //! Where it is least among points whose coordinate `axis` has the given value.
  Vector<Dim> minimiser(int axis, double value) const {
    auto rest = matrix;
    Vector<Dim> right = linear - value * matrix.col(axis);
    rest.row(axis).setZero();
    rest.col(axis).setZero();
    rest(axis, axis) = 1;
    right(axis) = value;
    return rest.inverse() * right;
  }
};

}  // namespace flbc

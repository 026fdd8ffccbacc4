// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Rotation of functions on the sphere.
#pragma once

#include <Eigen/Core>

namespace flbc::io {

//! Real spherical harmonics of one degree, in the order and with the signs of 3D Gaussian
//! splatting.
template <int Degree>
Eigen::Matrix<double, 2 * Degree + 1, 1> harmonics(const Eigen::Vector3d& d) {
  const double x = d.x(), y = d.y(), z = d.z();
  const double xx = x * x, yy = y * y, zz = z * z;
  Eigen::Matrix<double, 2 * Degree + 1, 1> values;
  if constexpr (Degree == 1) {
    values << -y, z, -x;
    values *= 0.4886025119029199;
  } else if constexpr (Degree == 2) {
    values << 1.0925484305920792 * x * y, -1.0925484305920792 * y * z,
        0.31539156525252005 * (2 * zz - xx - yy), -1.0925484305920792 * x * z,
        0.5462742152960396 * (xx - yy);
  } else {
    static_assert(Degree == 3);
    values << -0.5900435899266435 * y * (3 * xx - yy), 2.890611442640554 * x * y * z,
        -0.4570457994644658 * y * (4 * zz - xx - yy),
        0.3731763325901154 * z * (2 * zz - 3 * xx - 3 * yy),
        -0.4570457994644658 * x * (4 * zz - xx - yy), 1.445305721320277 * z * (xx - yy),
        -0.5900435899266435 * x * (xx - 3 * yy);
  }
  return values;
}

//! Rotates functions that are given by coefficients: f'(d) = f(R^T d). Harmonics of one degree are
//! determined by their values in 2 Degree + 1 directions, so the rotated function is interpolated
//! from these.
template <int Degree>
class TurnedHarmonics {
 public:
  static constexpr int kSize = 2 * Degree + 1;
  //! Coefficients of red, green, and blue.
  using Coefficients = Eigen::Matrix<double, kSize, 3>;

  TurnedHarmonics();

  Coefficients turn(const Eigen::Matrix3d& rotation, const Coefficients& coefficients) const {
    Coefficients values;
    for (int k = 0; k < kSize; ++k) {
      const Eigen::Vector3d before = rotation.transpose() * directions_.col(k);
      values.row(k) = harmonics<Degree>(before).transpose() * coefficients;
    }
    return from_values_ * values;
  }

 private:
  Eigen::Matrix<double, 3, kSize> directions_;
  Eigen::Matrix<double, kSize, kSize> from_values_;
};

}  // namespace flbc::io

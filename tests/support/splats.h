// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Gaussian splats made by hand, and what they look like.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "flbc/types.h"

namespace flbc::testing {

//! A file of splats in memory: a header and rows of floats.
struct Splats {
  std::vector<std::string> names;
  Eigen::MatrixXf values;  //!< a column per splat

  float& at(const std::string& name, Eigen::Index splat) {
    return values(std::find(names.begin(), names.end(), name) - names.begin(), splat);
  }
  double get(const std::string& name, Eigen::Index splat) const {
    return const_cast<Splats*>(this)->at(name, splat);
  }

  std::string text(const std::string& format = "binary_little_endian") const {
    std::string result = "ply\nformat " + format + " 1.0\ncomment made by hand\nelement vertex " +
                         std::to_string(values.cols()) + "\n";
    for (const auto& name : names) result += "property float " + name + "\n";
    result += "end_header\n";
    return result.append(reinterpret_cast<const char*>(values.data()),
                         sizeof(float) * static_cast<std::size_t>(values.size()));
  }

  //! The splats of such a text, with the names of these.
  Splats parse(const std::string& text) const {
    Splats result = *this;
    const std::size_t size = sizeof(float) * static_cast<std::size_t>(values.size());
    std::memcpy(result.values.data(), text.data() + text.size() - size, size);
    return result;
  }

  Eigen::Matrix3d covariance(Eigen::Index p) const {
    const Eigen::Matrix3d axes =
        Eigen::Quaterniond(get("rot_0", p), get("rot_1", p), get("rot_2", p), get("rot_3", p))
            .normalized()
            .toRotationMatrix();
    Eigen::Vector3d scale;
    for (int k = 0; k < 3; ++k) scale[k] = std::exp(2 * get("scale_" + std::to_string(k), p));
    return axes * scale.asDiagonal() * axes.transpose();
  }

  //! The color seen in a direction, without the constant part.
  Eigen::Vector3d color(Eigen::Index p, const Eigen::Vector3d& d, int degree) const {
    const double x = d.x(), y = d.y(), z = d.z(), xx = x * x, yy = y * y, zz = z * z;
    const double pi = 3.14159265358979323846;
    const double one = std::sqrt(3 / (4 * pi)), two = std::sqrt(15 / (4 * pi));
    const double three = std::sqrt(35 / (32 * pi)), four = std::sqrt(21 / (32 * pi));
    const std::vector<double> basis = {-one * y,
                                       one * z,
                                       -one * x,
                                       two * x * y,
                                       -two * y * z,
                                       std::sqrt(5 / (16 * pi)) * (2 * zz - xx - yy),
                                       -two * x * z,
                                       two / 2 * (xx - yy),
                                       -three * y * (3 * xx - yy),
                                       std::sqrt(105 / (4 * pi)) * x * y * z,
                                       -four * y * (4 * zz - xx - yy),
                                       std::sqrt(7 / (16 * pi)) * z * (2 * zz - 3 * xx - 3 * yy),
                                       -four * x * (4 * zz - xx - yy),
                                       std::sqrt(105 / (16 * pi)) * z * (xx - yy),
                                       -three * x * (xx - 3 * yy)};
    const int size = (degree + 1) * (degree + 1) - 1;
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (int c = 0; c < 3; ++c) {
      for (int k = 0; k < size; ++k) {
        sum[c] += basis[k] * get("f_rest_" + std::to_string(c * size + k), p);
      }
    }
    return sum;
  }
};

//! Random splats at some points.
inline Splats random_splats(const PointList<3>& points, int degree) {
  Splats splats;
  splats.names = {"x", "y", "z", "nx", "ny", "nz", "f_dc_0", "f_dc_1", "f_dc_2"};
  const int rest = 3 * ((degree + 1) * (degree + 1) - 1);
  for (int k = 0; k < rest; ++k) splats.names.push_back("f_rest_" + std::to_string(k));
  for (const char* name :
       {"opacity", "scale_0", "scale_1", "scale_2", "rot_0", "rot_1", "rot_2", "rot_3", "id"}) {
    splats.names.emplace_back(name);
  }
  splats.values =
      Eigen::MatrixXf::Random(static_cast<Eigen::Index>(splats.names.size()), points.cols());
  splats.values.topRows(3) = points.cast<float>();
  splats.values.middleRows(3, 3).setZero();
  return splats;
}

}  // namespace flbc::testing

// SPDX-License-Identifier: BSD-3-Clause
#include "cage/facet_distance.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

namespace flbc {
namespace {

template <int Dim>
double distance_to_segment(const Vector<Dim>& p, const Vector<Dim>& a, const Vector<Dim>& b) {
  const Vector<Dim> along = b - a;
  const double squared = along.squaredNorm();
  const double t = squared > 0 ? std::clamp((p - a).dot(along) / squared, 0.0, 1.0) : 0.0;
  return (p - a - t * along).norm();
}

}  // namespace

template <>
double distance_to_facet<2>(const Vector<2>& point, const Eigen::Matrix2d& corners) {
  return distance_to_segment<2>(point, corners.col(0), corners.col(1));
}

template <>
double distance_to_facet<3>(const Vector<3>& point, const Eigen::Matrix3d& corners) {
  const Vector<3> normal =
      (corners.col(1) - corners.col(0)).cross(corners.col(2) - corners.col(0)).normalized();
  bool is_above = normal.squaredNorm() > 0;
  double distance = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 3; ++k) {
    const Vector<3> from = corners.col(k);
    const Vector<3> to = corners.col((k + 1) % 3);
    is_above = is_above && normal.cross(to - from).dot(point - from) >= 0;
    distance = std::min(distance, distance_to_segment<3>(point, from, to));
  }
  return is_above ? std::abs(normal.dot(point - corners.col(0))) : distance;
}

}  // namespace flbc

// SPDX-License-Identifier: BSD-3-Clause
// From where models are looked at.
#pragma once

#include <cmath>

#include <Eigen/Geometry>

#include "flbc/types.h"
#include "front/up_axis.h"

namespace flbc::draw {

constexpr double kDegree = 3.14159265358979323846 / 180;

//! A parallel projection of space on the picture's plane.
struct ObliqueView {
  Vector<3> right;   //!< on the picture
  Vector<3> up;      //!< on the picture
  Vector<3> toward;  //!< to the eye

  Vector<2> project(const Vector<3>& p) const { return {right.dot(p), up.dot(p)}; }

  PointList<2> project(const PointList<3>& points) const {
    PointList<2> result(2, points.cols());
    result.row(0) = right.transpose() * points;
    result.row(1) = up.transpose() * points;
    return result;
  }
};

//! The view of a model before `turn` that shows it as `view` does after it.
inline ObliqueView before_turn(const ObliqueView& view, const Eigen::Matrix3d& turn) {
  const Eigen::Matrix3d back = turn.transpose();
  return {back * view.right, back * view.up, back * view.toward};
}

//! The view that shows most models well: from the front, the right and above.
constexpr double kUsualAzimuth = 35;
constexpr double kUsualElevation = 18;

//! A view by angles in degrees, with the y axis upwards.
//! \param azimuth  0 = from the front (z), 90 = from the side of x
//! \param elevation  90 = from above
inline ObliqueView view_by_angles(double azimuth, double elevation) {
  const double turn = azimuth * kDegree;
  const double rise = elevation * kDegree;
  const Vector<3> toward(std::cos(rise) * std::sin(turn), std::sin(rise),
                         std::cos(rise) * std::cos(turn));
  const Vector<3> right(std::cos(turn), 0, -std::sin(turn));
  return {right, toward.cross(right), toward};
}

//! The view of points as they are in their file, 3 x P: from the front, the right, and above.
inline ObliqueView view_of(app::UpAxis up, const PointList<3>& points) {
  const int axis = app::up_axis(up, points);
  const double front = app::front_azimuth(axis, points) * kDegree;
  return before_turn(view_by_angles(kUsualAzimuth, kUsualElevation),
                     Eigen::AngleAxisd(-front, Vector<3>::UnitY()) * app::turn_upright(axis));
}

}  // namespace flbc::draw

// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! From where a model in space is looked at.
#pragma once

#include <cmath>

#include "draw/oblique_view.h"

namespace flbc::draw {

//! The view that shows most models well: from the front, the right and above.
constexpr double kUsualAzimuth = 35;
constexpr double kUsualElevation = 18;

//! A view by angles in degrees, with the y axis upwards.
//! \param azimuth  0 = from the front (z), 90 = from the side of x
//! \param elevation  90 = from above
inline ObliqueView view_by_angles(double azimuth, double elevation) {
  constexpr double kDegree = 3.14159265358979323846 / 180;
  const double turn = azimuth * kDegree;
  const double rise = elevation * kDegree;
  const Vector<3> toward(std::cos(rise) * std::sin(turn), std::sin(rise),
                         std::cos(rise) * std::cos(turn));
  const Vector<3> right(std::cos(turn), 0, -std::sin(turn));
  return {right, toward.cross(right), toward};
}

}  // namespace flbc::draw

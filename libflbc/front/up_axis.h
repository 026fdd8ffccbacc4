// SPDX-License-Identifier: BSD-3-Clause
// Which axis of a model points up in pictures, pages, and exports.
#pragma once

#include <string>

#include <Eigen/Core>

#include "flbc/types.h"

namespace flbc::app {

enum class UpAxis { kX, kY, kZ, kAuto };

//! kY for kAuto and a glTF file, in which y points up by definition; otherwise `up`.
UpAxis up_of(UpAxis up, const std::string& model);

//! The axis, 0 to 2. For kAuto the first of y, z, and x along which the model stands: the center of
//! its vertices is above the bounding box of the lowest vertices (within 3% of the height), and
//! this box covers at least 10% of the area of the whole one. y if it stands along none.
//! \param points  3 x P
int up_axis(UpAxis up, const PointList<3>& points);

//! In the plane y points up. \throws OptionError if another axis is requested
int up_axis(UpAxis up, const PointList<2>& points);

//! The azimuth in degrees from which a standing model is seen from the front, 0, 90, 180, or -90:
//! that to which its feet point from the ankles. 0 if it does not stand, or its feet point nowhere.
//! \param up  axis, 0 to 2 \param points  3 x P
double front_azimuth(int up, const PointList<3>& points);

//! The rotation that takes an axis to y, by 90 degrees or not at all.
Eigen::Matrix3d turn_upright(int axis);

}  // namespace flbc::app

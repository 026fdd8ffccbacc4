// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "flbc/types.h"

namespace flbc {

//! The volume of the convex hull. \param points  not all in a plane
double hull_volume(const PointList<3>& points);

}  // namespace flbc

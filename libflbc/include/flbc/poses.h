// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Random poses of a cage, to measure deformations by.
#pragma once

#include <vector>

#include "flbc/types.h"

namespace flbc {

//! Poses in which every control point is displaced by 10 % of the cage's size in a random direction
//! of its own. The same ones on every machine.
//! \param control_points  Dim x n
//! \param count  number of poses
//! \return Dim x n each, in the units of the control points
template <int Dim>
std::vector<PointList<Dim>> independent_poses(const PointList<Dim>& control_points, int count);

//! Poses made by random smooth maps, a linear and a quadratic part of about 10 % of the cage's size
//! each. The same ones on every machine.
//! \param control_points  Dim x n
//! \param count  number of poses
//! \return Dim x n each, in the units of the control points
template <int Dim>
std::vector<PointList<Dim>> smooth_poses(const PointList<Dim>& control_points, int count);

}  // namespace flbc

// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Random poses of a cage, for measuring deformations.
#pragma once

#include <vector>

#include "flbc/types.h"

namespace flbc {

//! Poses that displace each control point by 10% of cage size in an independent random direction.
//! The poses are the same on every machine.
//! \param control_points  Dim x n
//! \param count  number of poses
//! \return Dim x n each, in the units of the control points
template <int Dim>
std::vector<PointList<Dim>> independent_poses(const PointList<Dim>& control_points, int count);

//! Poses from random smooth maps with a linear and a quadratic part, each about 10% of cage size.
//! The poses are the same on every machine.
//! \param control_points  Dim x n
//! \param count  number of poses
//! \return Dim x n each, in the units of the control points
template <int Dim>
std::vector<PointList<Dim>> smooth_poses(const PointList<Dim>& control_points, int count);

}  // namespace flbc

// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! How much a change of weights moves a point in the poses that matter.
#pragma once

#include <vector>

#include "flbc/types.h"

namespace flbc {

//! H, n x n, symmetric and positive definite, such that d . H d is, for differences d of weights
//! with sum d = 0 and sum d c = 0, the squared distance by which d moves a point, in units of a
//! tenth of the cage's size: the mean over the poses, to which a tenth of the expectation for poses
//! like those of independent_poses() and smooth_poses() is added, which keeps control points in
//! check that the given poses do not move. Without poses H is that expectation.
//! \param control_points  Dim x n \param poses  Dim x n each
template <int Dim>
Eigen::MatrixXd pose_metric(const PointList<Dim>& control_points,
                            const std::vector<PointList<Dim>>& poses);

}  // namespace flbc

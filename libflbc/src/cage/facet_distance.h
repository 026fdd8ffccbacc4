// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "flbc/types.h"

namespace flbc {

//! From a point to an edge (2D) or a triangle (3D), which may be degenerate.
//! \param corners  of the facet, a column each
template <int Dim>
double distance_to_facet(const Vector<Dim>& point, const Eigen::Matrix<double, Dim, Dim>& corners);
template <>
double distance_to_facet<2>(const Vector<2>& point, const Eigen::Matrix2d& corners);
template <>
double distance_to_facet<3>(const Vector<3>& point, const Eigen::Matrix3d& corners);

}  // namespace flbc

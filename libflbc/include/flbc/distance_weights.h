// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! The weight functions phi_i of the paper's problem (1): they make the variation of w_i dearer the
//! farther it is from its control point, which keeps w_i local.
#pragma once

#include "flbc/domain_mesh.h"
#include "flbc/geodesic_distances.h"

namespace flbc {

//! How phi_i grows with the relative distance d_i in [0, 1] from its control point.
enum class DistanceScheme {
  kSquare,      //!< d^2, the usual default
  kLinear,      //!< d
  kSquareRoot,  //!< sqrt(d)
  kConstant     //!< 1, plain total variation
};

//! Divides by the largest distance over all control points, averages over each cell's vertices and
//! applies the scheme.
//! \param scheme  growth with the distance
//! \param distances  n x V in any unit, or empty for kConstant
//! \param mesh  F cells, V vertices
//! \param num_control_points  n
//! \return n x F, phi_i on each cell, in [0, 1]
template <int Dim>
Eigen::MatrixXd distance_weights(DistanceScheme scheme, const Eigen::MatrixXd& distances,
                                 const DomainMesh<Dim>& mesh, Index num_control_points);

}  // namespace flbc

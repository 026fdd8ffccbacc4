// SPDX-License-Identifier: BSD-3-Clause
// How poses of a cage distort the cells of its mesh.
#pragma once

#include <vector>

#include "flbc/domain_mesh.h"

namespace flbc::app {

//! Means over the volume of a mesh (area in 2D). With singular values s_k of a cell's Jacobian:
struct Distortion {
  double isometric = 0;  //!< mean of sum_k (s_k - 1)^2; 0 for rigid motions
  double volume = 0;     //!< mean of |det - 1|; 0 if no cell changes its volume
  double flipped = 0;    //!< share of the volume whose cells are turned inside out
};

//! \param posed  the vertices of the mesh in a pose
template <int Dim>
Distortion distortion_of(const DomainMesh<Dim>& mesh, const PointList<Dim>& posed);

//! Poses of any cage. Along the longest side of its box, the displacements grow from the middle to
//! both ends: bent by 45 degrees, stretched by 40%, and, in 3D, twisted by 60 degrees.
template <int Dim>
std::vector<PointList<Dim>> test_poses(const PointList<Dim>& control_points);

}  // namespace flbc::app

// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Demands on the mesh of a cage's interior.
#pragma once

#include "flbc/domain_mesh.h"

namespace flbc {

//! Demands on the mesh of a cage's interior.
template <int Dim>
struct MeshingOptions {
  //! Number of vertices wanted, met within 5 % in 2D and about 10 % in 3D; 0 = as few as quality
  //! demands. \throws OptionError from the meshers if it is below what quality demands.
  Index vertices = 0;

  //! Points inside the cage that become mesh vertices: they follow the control points directly, in
  //! this order, with their coordinates unchanged.
  PointList<Dim> embedded_points{};

  //! Longest time in seconds for one run of a mesher, with all its further tries where it fails,
  //! after which it is stopped.
  double time_limit = 60;

  //! Whether to take the first mesh of about so many vertices, within a factor of three where the
  //! cage allows: one run of the mesher, enough for coarse meshes to start from (coarse_to_fine.h).
  bool roughly = false;
};

}  // namespace flbc

// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Pictures of coordinate functions in the plane.
#pragma once

#include <vector>

#include "draw/picture_options.h"
#include "draw/primitives.h"
#include "flbc/cage.h"
#include "flbc/domain_mesh.h"

namespace flbc::draw {

//! Draws one coordinate function: colours, isolines, the cage, its control points and, in red, the
//! one that the function belongs to.
//! \param values  V, the function's value at each vertex of the mesh
//! \throws InputError if a value is missing or not finite, OptionError if there is no such control
//! point or an option is outside its range
Image draw_weights(const Cage<2>& cage, const DomainMesh<2>& mesh, const Eigen::VectorXd& values,
                   Index control_point, const WeightPictureOptions& options = {});

//! Draws several coordinate functions as a sheet of small pictures, in rows.
//! \param weights  n x V
//! \param control_points  which to draw, at least one
//! \throws as draw_weights()
Image draw_all(const Cage<2>& cage, const DomainMesh<2>& mesh, const WeightMatrix& weights,
               const std::vector<Index>& control_points, const WeightPictureOptions& options = {});

}  // namespace flbc::draw

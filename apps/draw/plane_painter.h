// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! A function in the plane with its cage, as part of a picture.
#pragma once

#include <utility>
#include <vector>

#include "draw/canvas.h"
#include "draw/layout.h"
#include "draw/picture_options.h"
#include "flbc/cage.h"
#include "flbc/domain_mesh.h"

namespace flbc::draw {

//! Paints the function, the cage over it and the control point in red. \param unit  size of what is
//! 1 pixel wide in a picture of the usual width
void paint_function(Canvas& canvas, const PixelMap& map, const Cage<2>& cage,
                    const DomainMesh<2>& mesh, const Eigen::VectorXd& values, Index control_point,
                    const WeightPictureOptions& options, double unit);

//! The edges, by their ends, that belong to one triangle only.
std::vector<std::pair<Index, Index>> outline_of(const CellList<2>& triangles);

//! Paints the outline of a mesh, which tells a shape where the function is 0; to be covered by that
//! function and the cage.
void paint_outline(Canvas& canvas, const PixelMap& map, const PointList<2>& points,
                   const std::vector<std::pair<Index, Index>>& outline, double unit);

//! \throws InputError if an edge refers to a control point that does not exist
void check_edges(const Cage<2>& cage);

}  // namespace flbc::draw

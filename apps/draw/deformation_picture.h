// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Pictures of what a cage in the plane does to a shape.
#pragma once

#include "draw/picture_options.h"
#include "draw/primitives.h"
#include "flbc/cage.h"
#include "flbc/domain_mesh.h"

namespace flbc::draw {

//! Where the cage and the shape in it are.
struct DrawnShape {
  PointList<2> control_points;  //!< 2 x n
  PointList<2> points;          //!< 2 x P
};

//! Draws a shape and its cage before and after, side by side or, if they are wide, one above the
//! other, in the same scale and the same frame, coloured by one coordinate function.
//! \param facets  2 x m, of the cage
//! \param triangles  3 x T, of the shape
//! \param values  P
//! \throws InputError if sizes and indices do not belong together or a number is not finite,
//! OptionError as draw_weights()
Image draw_deformation(const FacetList<2>& facets, const CellList<2>& triangles,
                       const DrawnShape& before, const DrawnShape& after,
                       const Eigen::VectorXd& values, Index control_point,
                       const WeightPictureOptions& options = {});

}  // namespace flbc::draw

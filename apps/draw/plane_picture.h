// SPDX-License-Identifier: BSD-3-Clause
// Pictures of coordinate functions and deformations in the plane, as the bytes of a file.
#pragma once

#include <string>
#include <vector>

#include "draw/picture_options.h"
#include "flbc/cage.h"
#include "flbc/domain_mesh.h"

namespace flbc::draw {

//! Draws one coordinate function: colors, isolines, the cage, its control points and, in red, the
//! one that the function belongs to.
//! \param values  V, the function's value at each vertex of the mesh
//! \throws InputError if a value is missing or not finite, OptionError if there is no such control
//! point or an option is outside its range
std::string draw_weights(const Cage<2>& cage, const DomainMesh<2>& mesh,
                         const Eigen::VectorXd& values, Index control_point,
                         const WeightPictureOptions& options = {});

//! Draws several coordinate functions as a sheet of small pictures, in rows.
//! \param weights  n x V
//! \param control_points  which to draw, at least one
//! \throws as draw_weights()
std::string draw_all(const Cage<2>& cage, const DomainMesh<2>& mesh, const WeightMatrix& weights,
                     const std::vector<Index>& control_points,
                     const WeightPictureOptions& options = {});

struct DrawnShape {
  PointList<2> control_points;  //!< 2 x n
  PointList<2> points;          //!< 2 x P
};

//! Draws a shape and its cage before and after, side by side or, if they are wide, one above the
//! other, in the same scale and the same frame, colored by one coordinate function or in
//! squares that are deformed with it.
//! \param facets  2 x m, of the cage
//! \param triangles  3 x T, of the shape
//! \param values  P; empty for the squares, without a control point in red
//! \throws InputError if sizes and indices do not belong together or a number is not finite,
//! OptionError as draw_weights()
std::string draw_deformation(const FacetList<2>& facets, const CellList<2>& triangles,
                             const DrawnShape& before, const DrawnShape& after,
                             const Eigen::VectorXd& values, Index control_point,
                             const WeightPictureOptions& options = {});

struct PlanePanel {
  std::string label;
  DrawnShape shape;
  Eigen::VectorXd values;  //!< P; empty: squares, which are deformed with the shape
};

//! Draws panels in rows, in the same scale and frame, with a label above each.
//! \param facets  2 x m, of the cage \param triangles  3 x T, of the shape
//! \param rest  2 x P, where the squares are square \param control_point  of the values
//! \throws as draw_deformation()
std::string draw_panels(const FacetList<2>& facets, const CellList<2>& triangles,
                        const std::vector<PlanePanel>& panels, const PointList<2>& rest,
                        Index control_point, const WeightPictureOptions& options = {});

}  // namespace flbc::draw

// SPDX-License-Identifier: BSD-3-Clause
// Pictures of coordinate functions and deformations in the plane, as the bytes of a file.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "draw/picture_options.h"
#include "flbc/cage.h"
#include "flbc/domain_mesh.h"

namespace flbc::draw {

struct DrawnShape {
  PointList<2> control_points;  //!< 2 x n
  PointList<2> points;          //!< 2 x P
};

struct PlanePanel {
  std::string label;
  std::shared_ptr<const DrawnShape> shape;
  Eigen::VectorXd values{};  //!< P; empty: squares, which are deformed with the shape
  Index control_point = -1;  //!< of the values
};

//! Draws panels in rows, in the same scale and frame, with a label above each and, next to a single
//! one with values, the scale of their colors.
//! \param facets  2 x m, of the cage \param triangles  3 x T, of the shape
//! \param rest  2 x P, where the squares are square
//! \throws OptionError if an option is outside its range; InputError if there is no extent
std::string draw_panels(const FacetList<2>& facets, const CellList<2>& triangles,
                        const std::vector<PlanePanel>& panels, const PointList<2>& rest,
                        const WeightPictureOptions& options = {});

//! Draws one coordinate function: colors, isolines, the cage, its control points and, in red, the
//! one that the function belongs to. \param values  V, at each vertex of the mesh
std::string draw_weights(const Cage<2>& cage, const DomainMesh<2>& mesh,
                         const Eigen::VectorXd& values, Index control_point,
                         const WeightPictureOptions& options = {});

//! Draws a shape at rest and in a pose as two such panels.
std::string draw_poses(const FacetList<2>& facets, const CellList<2>& triangles,
                       const DrawnShape& rest, const DrawnShape& pose,
                       const WeightPictureOptions& options = {});

}  // namespace flbc::draw

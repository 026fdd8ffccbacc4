// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Cages from models. Implemented by the optional component `caging`.
#pragma once

#include "flbc/cage.h"

namespace flbc {

//! Whether a cage is its own mirror image.
enum class CageSymmetry {
  kNone,
  kX,  //!< across the plane (2D: line) x = constant through the center of the model
  kY,
  kZ,    //!< 3D only
  kAuto  //!< across such a plane if the model's vertices are symmetric to it, to 0.5 % of its size
};

//! How a cage is made.
struct CagingOptions {
  Index control_points = 0;  //!< maximum number, >= Dim + 1; 0: 50 to 150 (2D: 12 to 60) by shape
  double offset = 0;  //!< distance from the model, in its units; 0: by the number of control points
  CageSymmetry symmetry = CageSymmetry::kAuto;
};

//! A cage and its properties.
template <int Dim>
struct ModelCage {
  Cage<Dim> cage;             //!< counter-clockwise (2D), normals outwards (3D)
  double offset = 0;          //!< in the model's units
  int symmetry_axis = -1;     //!< 0, 1, 2: the axis across which it is symmetric; -1: none
  double symmetry_place = 0;  //!< coordinate of the symmetry plane
  double mean_distance = 0;   //!< of the cage from the model, in the model's units
};

//! A closed, manifold cage that does not intersect itself and has every vertex, edge and facet of
//! the model strictly inside, which is checked exactly. The model is wrapped (3D: by alpha
//! wrapping; 2D: along a fine grid), and edges of the wrap are collapsed as long as it encloses the
//! model. Parts that are far apart may get separate closed surfaces. The same input gives the
//! same cage. \param points  Dim x P, finite \param facets  Dim x F, edges or triangles in any
//! state: open, not manifold, intersecting or
//!   degenerate; repeated corners make segments and points of them. Points of no facet are enclosed
//!   as well
//! \throws InputError if the model has no extent or cannot be enclosed, OptionError
template <int Dim>
ModelCage<Dim> cage_from_model(const PointList<Dim>& points, const FacetList<Dim>& facets,
                               const CagingOptions& options = {});

}  // namespace flbc

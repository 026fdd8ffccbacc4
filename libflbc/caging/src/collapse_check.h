// SPDX-License-Identifier: BSD-3-Clause
// Checks that a surface still encloses the model when a vertex moves.
#pragma once

#include <limits>
#include <vector>

#include "caging/editable_surface.h"
#include "caging/enclosure.h"

namespace flbc {

//! The current facets and their replacements.
template <int Dim>
struct Replacement {
  std::vector<Index> old_facets{};              //!< facets to remove
  std::vector<FacetCorners<Dim>> new_facets{};  //!< each contains the vertex
  std::vector<Index> predecessors{};            //!< the old facet of each new one
  Index vertex = -1;
  Index removed = -1;  //!< the vertex that becomes one with it; -1: none
  bool is_in_plane = false;
};

template <int Dim>
Replacement<Dim> replacement_of(const Collapse<Dim>& plan);

//! The facets at a moving vertex.
template <int Dim>
Replacement<Dim> replacement_of(const EditableSurface<Dim>& surface, Index vertex);

//! Limits of a cage, so that it has no spikes and no crowded vertices.
struct CageLimits {
  Index valence = std::numeric_limits<Index>::max();        //!< edges at a control point, in 3D
  double reach = std::numeric_limits<double>::infinity();   //!< distance of one from the model
  double growth = std::numeric_limits<double>::infinity();  //!< 3D: of the volume, by collapses
  std::vector<double> lengths{};    //!< of edges, at the vertices of the surface; empty: any
  std::vector<double> densities{};  //!< of control points, at the vertices
  bool lengths_grow = false;        //!< until the number of control points is reached
};

//! \param clearance  new facets keep about this distance from the model
template <int Dim>
class CollapseCheck {
 public:
  CollapseCheck(const EditableSurface<Dim>& surface, const Enclosure<Dim>& enclosure,
                double clearance, const CageLimits& limits);

  //! Whether the vertex position is valid: the surface does not intersect itself, strictly encloses
  //! the model, inverts no facet, makes no facet much flatter, and respects the limits.
  bool allows(const Replacement<Dim>& change, const Vector<Dim>& position) const;

 private:
  bool keeps_limits(const Replacement<Dim>& change, const Vector<Dim>& position) const;
  bool keeps_shape(const Replacement<Dim>& change, const Vector<Dim>& position) const;
  bool keeps_half(const Replacement<Dim>& change, const Vector<Dim>& position) const;
  bool meets_surface(const Replacement<Dim>& change, const Vector<Dim>& position) const;
  bool meets_model(const Replacement<Dim>& change, const Vector<Dim>& position) const;
  bool loses_parts(const Replacement<Dim>& change, const Vector<Dim>& position) const;

  const EditableSurface<Dim>& surface_;
  const Enclosure<Dim>& enclosure_;
  double clearance_;
  CageLimits limits_;
  mutable PointList<Dim> moved_;    // of the surface, where meets_surface() needs them
  PointList<Dim> representatives_;  // of the parts of the model, on the side of the plane
};

}  // namespace flbc

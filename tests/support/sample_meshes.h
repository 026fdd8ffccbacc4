// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Tiny cages with meshes of their interiors, made in code, the same way in 2D and 3D: a coarse
//! mesh whose boundary is the cage is subdivided regularly.
#pragma once

#include <string>
#include <vector>

#include "flbc/cage.h"
#include "flbc/domain_mesh.h"
#include "support/coarse_shapes.h"

namespace flbc::testing {

//! A cage, oriented outward, and a conforming mesh of its interior. The control points are mesh
//! vertices (in no particular place) and every cage facet is a union of mesh facets.
template <int Dim>
struct Sample {
  Cage<Dim> cage;
  DomainMesh<Dim> mesh;
  std::string name;
};

//! The boundary of a mesh of positive cells as a cage, oriented outward.
template <int Dim>
Cage<Dim> boundary_of(const DomainMesh<Dim>& mesh);

//! The unit cube's surface, of 2 k^2 triangles a side, blown up to the unit ball; 6 k^2 + 2 control
//! points.
Cage<3> round_cage(Index k);

//! \param subdivisions  k >= 1: every coarse cell becomes k^Dim cells
//! \param jitter  moves interior vertices by up to this part of the least height of their cells,
//!     the same way on every machine; 0 leaves them in place
//! \throws std::invalid_argument if subdivisions < 1, or if the jitter turns a cell round (no
//!     jitter below 0.25 can)
template <int Dim>
Sample<Dim> make_sample(Shape shape, Index subdivisions, double jitter = 0);

//! All shapes with 50 to 400 vertices, most of them jittered, each with interior vertices.
template <int Dim>
std::vector<Sample<Dim>> samples();

}  // namespace flbc::testing

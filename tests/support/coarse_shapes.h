// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! The coarse meshes from which sample_meshes.h makes its samples.
#pragma once

#include <string>

#include "flbc/domain_mesh.h"

namespace flbc::testing {

enum class Shape {
  kSimplex,  //!< an irregular triangle or tetrahedron
  kBox,      //!< the unit square in right triangles or the unit cube in Kuhn tetrahedra
  kCorner,   //!< an L of three unit squares; in 3D of height 1
  kRing,     //!< a 3 x 3 square with a 1 x 1 hole; in 3D of height 1, a block of genus 1
  kStar      //!< a fan of 2^Dim cells around the origin, irregular
};

//! A conforming mesh whose vertices are the corners of the shape (and the center of the star). The
//! orientation of its cells is arbitrary.
template <int Dim>
DomainMesh<Dim> coarse_mesh(Shape shape);

//! A word for the shape, for names of samples.
std::string shape_name(Shape shape);

}  // namespace flbc::testing

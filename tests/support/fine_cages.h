// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Cages with more control points than the coarse shapes have corners.
#pragma once

#include "support/test.h"

namespace flbc::testing {

//! A shape whose cage is subdivided. \param cage_subdivisions  divides `subdivisions`
template <int Dim>
Sample<Dim> with_fine_cage(Shape shape, Index cage_subdivisions, Index subdivisions) {
  if (subdivisions % cage_subdivisions != 0) {
    throw std::invalid_argument("the mesh has to refine the cage");
  }
  auto sample = make_sample<Dim>(shape, subdivisions, 0.2);
  sample.cage = boundary_of(make_sample<Dim>(shape, cage_subdivisions).mesh);
  return sample;
}

}  // namespace flbc::testing

// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Samples on refined meshes, without a mesher.
#pragma once

#include "flbc/nested_mesh.h"
#include "support/sample_meshes.h"

namespace flbc::testing {

//! A sample on the refinement of its mesh.
template <int Dim>
Sample<Dim> refined_sample(Shape shape, Index resolution) {
  auto sample = make_sample<Dim>(shape, resolution, 0.2);
  sample.mesh = refine(sample.mesh);
  return sample;
}

//! The same cells in an order in which the mesh is not recognized as refined.
template <int Dim>
DomainMesh<Dim> in_other_order(DomainMesh<Dim> mesh) {
  mesh.cells.col(0).swap(mesh.cells.col(1));
  return mesh;
}

}  // namespace flbc::testing

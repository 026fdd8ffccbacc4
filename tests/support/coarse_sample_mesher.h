// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Coarser meshes of a shape without a mesher.
#pragma once

#include "flbc/bounding_box.h"
#include "flbc/coarse_to_fine.h"
#include "support/sample_meshes.h"

namespace flbc::testing {

//! The mesh of a sample where and as large as a cage of the same shape.
template <int Dim>
DomainMesh<Dim> mesh_in(const Cage<Dim>& cage, const Sample<Dim>& sample) {
  const double scale =
      bounding_box_diagonal(cage.points) / bounding_box_diagonal(sample.cage.points);
  const Vector<Dim> shift = cage.points.col(0) - scale * sample.cage.points.col(0);
  return {(scale * sample.mesh.points).colwise() + shift, sample.mesh.cells};
}

template <int Dim>
CoarseMesher<Dim> coarse_sample_mesher(Index resolution, Shape shape = Shape::kCorner) {
  return [resolution, shape](const Cage<Dim>& cage, Index) {
    return mesh_in(cage, make_sample<Dim>(shape, resolution, 0.2));
  };
}

}  // namespace flbc::testing

// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Coarser meshes of a shape without a mesher.
#pragma once

#include "flbc/bounding_box.h"
#include "flbc/coarse_to_fine.h"
#include "support/sample_meshes.h"

namespace flbc::testing {

//! The sample's shape with fewer cells, where and as large as the cage given.
template <int Dim>
CoarseMesher<Dim> coarse_sample_mesher(Index resolution, Shape shape = Shape::kCorner) {
  return [resolution, shape](const Cage<Dim>& cage, Index) {
    auto sample = make_sample<Dim>(shape, resolution, 0.2);
    const double scale =
        bounding_box_diagonal(cage.points) / bounding_box_diagonal(sample.cage.points);
    const Vector<Dim> shift = cage.points.col(0) - scale * sample.cage.points.col(0);
    sample.mesh.points = (scale * sample.mesh.points).colwise() + shift;
    return sample.mesh;
  };
}

}  // namespace flbc::testing

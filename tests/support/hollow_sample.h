// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! A box with a box-shaped hole: the boundary has two components in 2D and in 3D.
#pragma once

#include "support/test.h"

namespace flbc::testing {

//! A box of 5 cells a side without one that is not the central one, cut into simplices. The cage
//! has the corners of both boxes; the whole is sheared a little, so that it is not symmetric.
template <int Dim>
Sample<Dim> make_hollow_sample() {
  Sample<Dim> sample;
  sample.name = "hollow" + std::to_string(Dim) + "d";
  const auto box = make_sample<Dim>(Shape::kBox, 5);
  std::vector<Index> kept;
  for (Index s = 0; s < box.mesh.num_cells(); ++s) {
    Vector<Dim> centre = Vector<Dim>::Zero();
    for (int k = 0; k <= Dim; ++k) centre += box.mesh.points.col(box.mesh.cells(k, s)) / (Dim + 1);
    if ((centre.array() - 0.3).abs().maxCoeff() > 0.1) kept.push_back(s);
  }
  sample.mesh.points = box.mesh.points;
  sample.mesh.cells = box.mesh.cells(Eigen::all, kept);

  auto hole = reversed(box.cage);
  hole.points = (0.2 * hole.points).array() + 0.2;
  sample.cage = join(box.cage, hole);
  const auto shear = [](PointList<Dim>& points) {
    points.row(0) += 0.3 * points.row(1);
    points.row(Dim - 1) -= 0.15 * points.row(0);
  };
  shear(sample.cage.points);
  shear(sample.mesh.points);
  return sample;
}

}  // namespace flbc::testing

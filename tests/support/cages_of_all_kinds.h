// SPDX-License-Identifier: BSD-3-Clause
// Cages for tests of coordinates that are evaluated at points.
#pragma once

#include "support/hollow_sample.h"

namespace flbc::testing {

constexpr double kPi = 3.14159265358979323846;

// Cages of all kinds with points inside, among them the centers of their cells.
template <int Dim>
std::vector<Sample<Dim>> cages() {
  std::vector<Sample<Dim>> all{make_hollow_sample<Dim>()};
  for (const auto shape :
       {Shape::kSimplex, Shape::kBox, Shape::kCorner, Shape::kRing, Shape::kStar}) {
    all.push_back(make_sample<Dim>(shape, 3));
  }
  return all;
}

template <int Dim>
PointList<Dim> centers(const DomainMesh<Dim>& mesh) {
  PointList<Dim> points = PointList<Dim>::Zero(Dim, mesh.num_cells());
  for (Index s = 0; s < mesh.num_cells(); ++s) {
    for (int k = 0; k <= Dim; ++k) points.col(s) += mesh.points.col(mesh.cells(k, s)) / (Dim + 1);
  }
  return points;
}

}  // namespace flbc::testing

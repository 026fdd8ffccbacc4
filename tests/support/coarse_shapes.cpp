// SPDX-License-Identifier: BSD-3-Clause
#include "support/coarse_shapes.h"

#include <algorithm>
#include <array>
#include <numeric>

namespace flbc::testing {
namespace {

// The coarse meshes have no vertices but the corners of the shape (and the center of the star).
DomainMesh<2> coarse_polygon(Shape shape) {
  if (shape == Shape::kBox) {
    return {PointList<2>{{0, 1, 0, 1}, {0, 0, 1, 1}}, CellList<2>{{0, 0}, {1, 2}, {3, 3}}};
  }
  if (shape == Shape::kCorner) {
    return {PointList<2>{{0, 2, 2, 1, 1, 0}, {0, 0, 1, 1, 2, 2}},
            CellList<2>{{0, 1, 0, 3}, {1, 2, 3, 4}, {3, 3, 5, 5}}};
  }
  DomainMesh<2> ring{PointList<2>{{0, 3, 3, 0, 1, 2, 2, 1}, {0, 0, 3, 3, 1, 1, 2, 2}},
                     CellList<2>(3, 8)};
  for (Index k = 0; k < 4; ++k) {
    const Index next = (k + 1) % 4;
    ring.cells.col(2 * k) << k, next, next + 4;
    ring.cells.col(2 * k + 1) << k, next + 4, k + 4;
  }
  return ring;
}

// Prisms of height 1 over the triangles, each cut into tetrahedra along the monotone paths through
// its vertices; since the paths follow the vertex order, neighboring prisms agree.
DomainMesh<3> extrude(const DomainMesh<2>& base) {
  const Index num_base = base.num_vertices();
  DomainMesh<3> mesh;
  mesh.points.resize(3, 2 * num_base);
  mesh.points.topLeftCorner(2, num_base) = base.points;
  mesh.points.topRightCorner(2, num_base) = base.points;
  mesh.points.row(2).head(num_base).setZero();
  mesh.points.row(2).tail(num_base).setOnes();
  mesh.cells.resize(4, 3 * base.num_cells());
  for (Index s = 0; s < base.num_cells(); ++s) {
    std::array<Index, 3> low{base.cells(0, s), base.cells(1, s), base.cells(2, s)};
    std::sort(low.begin(), low.end());
    for (int rise = 0; rise < 3; ++rise) {
      for (int k = 0, slot = 0; k < 3; ++k) {
        if (k <= rise) mesh.cells(slot++, 3 * s + rise) = low[k];
        if (k >= rise) mesh.cells(slot++, 3 * s + rise) = low[k] + num_base;
      }
    }
  }
  return mesh;
}

template <int Dim>
DomainMesh<Dim> coarse_simplex() {
  DomainMesh<Dim> mesh;
  mesh.points.resize(Dim, Dim + 1);
  if constexpr (Dim == 2) {
    mesh.points << 0, 2, 0.6,  //
        0, 0.3, 1.7;
  } else {
    mesh.points << 0, 2, 0.6, 0.4,  //
        0, 0.3, 1.7, 0.5,           //
        0, -0.2, 0.1, 1.5;
  }
  mesh.cells.resize(Dim + 1, 1);
  std::iota(mesh.cells.data(), mesh.cells.data() + Dim + 1, 0);
  return mesh;
}

// Two vertices on each axis, a cell per orthant.
template <int Dim>
DomainMesh<Dim> coarse_star() {
  DomainMesh<Dim> mesh;
  mesh.points = PointList<Dim>::Zero(Dim, 2 * Dim + 1);
  for (int axis = 0; axis < Dim; ++axis) {
    mesh.points(axis, 2 * axis) = 1 + 0.4 * axis;
    mesh.points(axis, 2 * axis + 1) = -0.8 - 0.3 * axis;
  }
  mesh.cells.resize(Dim + 1, 1 << Dim);
  for (Index orthant = 0; orthant < (1 << Dim); ++orthant) {
    for (int axis = 0; axis < Dim; ++axis) {
      mesh.cells(axis, orthant) = 2 * axis + ((orthant >> axis) & 1);
    }
    mesh.cells(Dim, orthant) = 2 * Dim;
  }
  return mesh;
}

}  // namespace

template <int Dim>
DomainMesh<Dim> coarse_mesh(Shape shape) {
  if (shape == Shape::kSimplex) {
    return coarse_simplex<Dim>();
  } else if (shape == Shape::kStar) {
    return coarse_star<Dim>();
  } else if constexpr (Dim == 2) {
    return coarse_polygon(shape);
  } else {
    return extrude(coarse_polygon(shape));
  }
}

std::string shape_name(Shape shape) {
  constexpr const char* kNames[] = {"simplex", "box", "corner", "ring", "star"};  // as in Shape
  return kNames[static_cast<int>(shape)];
}

template DomainMesh<2> coarse_mesh<2>(Shape);
template DomainMesh<3> coarse_mesh<3>(Shape);

}  // namespace flbc::testing

// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Properties of any mesh of a cage's interior.
#pragma once

#include "flbc/meshing.h"
#include "support/test.h"

namespace flbc::testing {

template <int Dim>
MeshingOptions<Dim> vertices(Index count, const PointList<Dim>& embedded = PointList<Dim>(Dim, 0)) {
  MeshingOptions<Dim> options{count};
  options.embedded_points = embedded;
  return options;
}

template <int Dim>
DomainMesh<Dim> fill(const Cage<Dim>& cage, const MeshingOptions<Dim>& options) {
  if constexpr (Dim == 2) {
    return triangulate(cage, options);
  } else {
    return tetrahedralize(cage, options);
  }
}

//! Two runs are bit-identical. \param make  gives a mesh
template <class Make>
void expect_reproducible(const Make& make) {
  const auto first = make(), second = make();
  ASSERT_EQ(first.num_vertices(), second.num_vertices());
  EXPECT_EQ(first.points, second.points);
  EXPECT_EQ(first.cells, second.cells);
}

//! Sum of the lengths of edges or the areas of triangles.
template <int Dim>
double sum_of_facets(const PointList<Dim>& points, const FacetList<Dim>& facets) {
  double sum = 0;
  for (Index f = 0; f < facets.cols(); ++f) {
    const Vector<Dim> a = points.col(facets(0, f)), b = points.col(facets(1, f));
    if constexpr (Dim == 2) {
      sum += (b - a).norm();
    } else {
      const Vector<3> c = points.col(facets(2, f));
      sum += (b - a).cross(c - a).norm() / 2;
    }
  }
  return sum;
}

//! Area or volume by the divergence theorem; positive for counterclockwise loops and outward
//! shells.
template <int Dim>
double enclosed_measure(const Cage<Dim>& cage) {
  double sum = 0;
  for (Index f = 0; f < cage.facets.cols(); ++f) {
    Eigen::Matrix<double, Dim, Dim> corners;
    for (int k = 0; k < Dim; ++k) corners.col(k) = cage.points.col(cage.facets(k, f));
    sum += corners.determinant() / (Dim == 2 ? 2 : 6);
  }
  return sum;
}

template <int Dim>
double total_volume(const DomainMesh<Dim>& mesh) {
  double sum = 0;
  for (Index cell = 0; cell < mesh.num_cells(); ++cell) sum += signed_measure(mesh, cell);
  return sum;
}

//! Do all corners of a mesh facet lie in one cage facet?
template <int Dim>
bool lies_in_one_facet(const Cage<Dim>& cage, const PointList<Dim>& points,
                       const Eigen::Matrix<Index, Dim, 1>& corners, double tolerance) {
  for (Index f = 0; f < cage.facets.cols(); ++f) {
    const Vector<Dim> a = cage.points.col(cage.facets(0, f)),
                      b = cage.points.col(cage.facets(1, f));
    bool has_all = true;
    for (int k = 0; k < Dim && has_all; ++k) {
      const Vector<Dim> p = points.col(corners(k));
      if constexpr (Dim == 2) {
        has_all = (p - a).norm() + (p - b).norm() <= (b - a).norm() + tolerance;
      } else {
        // Inside the prism over the triangle: heights over its plane and inward from its edges.
        const Vector<3> c = cage.points.col(cage.facets(2, f));
        const Vector<3> normal = (b - a).cross(c - a).normalized();
        has_all = std::abs(normal.dot(p - a)) <= tolerance;
        for (const auto& [from, to] : {std::pair(a, b), std::pair(b, c), std::pair(c, a)}) {
          has_all = has_all && normal.cross(to - from).normalized().dot(p - from) >= -tolerance;
        }
      }
    }
    if (has_all) return true;
  }
  return false;
}

//! The points are exactly the vertices of the mesh from `first` on.
template <int Dim>
void expect_vertices(const DomainMesh<Dim>& mesh, Index first, const PointList<Dim>& points) {
  ASSERT_GE(mesh.num_vertices(), first + points.cols());
  EXPECT_EQ(PointList<Dim>(mesh.points.middleCols(first, points.cols())), points);
}

//! The corners of the boundary facets.
template <int Dim>
FacetList<Dim> boundary_facets(const DomainMesh<Dim>& mesh) {
  const MeshTopology<Dim> topology = build_topology(mesh);
  FacetList<Dim> boundary(Dim, topology.num_facets());
  Index count = 0;
  for (Index facet = 0; facet < topology.num_facets(); ++facet) {
    if (topology.is_boundary(facet)) boundary.col(count++) = topology.facets.col(facet);
  }
  boundary.conservativeResize(Dim, count);
  return boundary;
}

//! Does every boundary facet of the mesh lie in one facet of the cage, so that the cage's edges are
//! covered by edges of the mesh?
template <int Dim>
bool covers_edges(const Cage<Dim>& cage, const DomainMesh<Dim>& mesh) {
  const FacetList<Dim> boundary = boundary_facets(mesh);
  const double tolerance = 1e-9 * bounding_box_diagonal<Dim>(cage.points);
  for (Index facet = 0; facet < boundary.cols(); ++facet) {
    if (!lies_in_one_facet<Dim>(cage, mesh.points, boundary.col(facet), tolerance)) return false;
  }
  return boundary.cols() > 0;
}

//! Control points first, cells positive and all of the interior, boundary vertices on the cage and
//! boundary facets all of it. \param interior_measure  area or volume that the mesh must have
template <int Dim>
void expect_fills(const Cage<Dim>& cage, const DomainMesh<Dim>& mesh, double interior_measure) {
  expect_vertices<Dim>(mesh, 0, cage.points);
  for (Index cell = 0; cell < mesh.num_cells(); ++cell) EXPECT_GT(signed_measure(mesh, cell), 0);
  EXPECT_NEAR(total_volume(mesh), interior_measure, 1e-9 * interior_measure);

  const FacetList<Dim> boundary = boundary_facets(mesh);
  const double tolerance = 1e-9 * bounding_box_diagonal<Dim>(cage.points);
  Index num_astray = 0;
  for (Index vertex : boundary.reshaped()) {
    // A vertex is a facet whose corners coincide.
    const Eigen::Matrix<Index, Dim, 1> corners = Eigen::Matrix<Index, Dim, 1>::Constant(vertex);
    num_astray += !lies_in_one_facet<Dim>(cage, mesh.points, corners, tolerance);
  }
  EXPECT_EQ(num_astray, 0) << "boundary vertices beside the cage";
  const double surface = sum_of_facets<Dim>(cage.points, cage.facets);
  EXPECT_NEAR(sum_of_facets<Dim>(mesh.points, boundary), surface, 1e-9 * surface);
}

//! The number of vertices is met up to a relative error.
template <int Dim>
void expect_count(const DomainMesh<Dim>& mesh, Index wanted, double tolerance) {
  EXPECT_NEAR(mesh.num_vertices(), wanted, tolerance * wanted);
}

}  // namespace flbc::testing

// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Meshes whose elements differ by their points, and rows of numbers made of them: for
//! tests that rows stay with their elements.
#pragma once

#include <OpenMesh/Core/IO/MeshIO.hh>
#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>

#include "flbc/openmesh/wide_property.h"
#include "support/test.h"

namespace flbc::testing {

struct DoublePoints : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;
  using Normal = OpenMesh::Vec3d;
};

struct PlanePoints : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec2d;
};
using FloatTri = OpenMesh::TriMesh_ArrayKernelT<>;
using FloatPoly = OpenMesh::PolyMesh_ArrayKernelT<>;
using DoubleTri = OpenMesh::TriMesh_ArrayKernelT<DoublePoints>;
using DoublePoly = OpenMesh::PolyMesh_ArrayKernelT<DoublePoints>;
using PlaneTri = OpenMesh::TriMesh_ArrayKernelT<PlanePoints>;

template <class MeshType, class Number>
struct WideCase {
  using Mesh = MeshType;
  using Scalar = Number;
};
//! Every kind of mesh with every kind of number.
using WideCases = ::testing::Types<WideCase<FloatTri, float>, WideCase<DoubleTri, double>,
                                   WideCase<FloatPoly, double>, WideCase<DoublePoly, float>>;

//! n x n squares; triangle meshes split them. All points are integers: sums of them are exact.
template <class Mesh>
Mesh make_squares(int n = 6) {
  Mesh mesh;
  std::vector<OpenMesh::VertexHandle> v;
  for (int y = 0; y <= n; ++y) {
    for (int x = 0; x <= n; ++x) {
      v.push_back(mesh.add_vertex(typename Mesh::Point(static_cast<typename Mesh::Scalar>(x),
                                                       static_cast<typename Mesh::Scalar>(y), 0)));
    }
  }
  for (int y = 0; y < n; ++y) {
    for (int x = 0; x < n; ++x) {
      const int k = y * (n + 1) + x;
      mesh.add_face(
          std::vector<OpenMesh::VertexHandle>{v[k], v[k + 1], v[k + n + 2], v[k + n + 1]});
    }
  }
  return mesh;
}

//! That elements can be deleted.
template <class Mesh>
void request_status(Mesh& mesh) {
  mesh.request_vertex_status();
  mesh.request_edge_status();
  mesh.request_halfedge_status();
  mesh.request_face_status();
}

//! A distinct number for every element of a kind; at most 5000.
template <class Mesh>
int key(const Mesh& mesh, OpenMesh::VertexHandle v) {
  return static_cast<int>(mesh.point(v)[0] + 100 * mesh.point(v)[1]);
}
template <class Mesh>
int key(const Mesh& mesh, OpenMesh::HalfedgeHandle h) {
  return key(mesh, mesh.from_vertex_handle(h)) + 2 * key(mesh, mesh.to_vertex_handle(h));
}
template <class Mesh>
int key(const Mesh& mesh, OpenMesh::EdgeHandle e) {
  const auto h = mesh.halfedge_handle(e, 0);
  return key(mesh, mesh.from_vertex_handle(h)) + key(mesh, mesh.to_vertex_handle(h));
}
template <class Mesh>
int key(const Mesh& mesh, OpenMesh::FaceHandle f) {
  int sum = 0;
  for (const auto v : mesh.fv_range(f)) sum += key(mesh, v);
  return sum;
}

//! Exact in float for c < 4, i < 32.
template <class Scalar>
Scalar number(int key, std::size_t c, std::size_t i) {
  return static_cast<Scalar>(128 * key + 32 * static_cast<int>(c) + static_cast<int>(i) + 1);
}

template <class Scalar>
void fill(openmesh::RowsView<Scalar> rows, int key) {
  for (std::size_t c = 0; c < rows.components(); ++c) {
    for (std::size_t i = 0; i < rows.width(); ++i) rows(c, i) = number<Scalar>(key, c, i);
  }
}

//! A mesh and the kinds of properties of such numbers.
template <class Case>
struct WidePropertyTest : ::testing::Test {
  using Numbers = openmesh::Wide<typename Case::Scalar>;
  using Vertices = OpenMesh::VPropHandleT<Numbers>;
  using Halfedges = OpenMesh::HPropHandleT<Numbers>;
  using Edges = OpenMesh::EPropHandleT<Numbers>;
  using Faces = OpenMesh::FPropHandleT<Numbers>;
  using OfMesh = OpenMesh::MPropHandleT<Numbers>;

  typename Case::Mesh mesh_ = make_squares<typename Case::Mesh>();
};

//! Shape and numbers.
template <class Scalar>
bool is_filled(openmesh::RowsView<const Scalar> rows, int key, std::size_t components,
               std::size_t width) {
  if (rows.components() != components || rows.width() != width) return false;
  for (std::size_t c = 0; c < components; ++c) {
    for (std::size_t i = 0; i < width; ++i) {
      if (rows(c, i) != number<Scalar>(key, c, i)) return false;
    }
  }
  return true;
}

//! Adds a property to all elements of the kind of Handle, with the numbers of their keys.
template <class Handle, class Mesh>
Handle add_filled(Mesh& mesh, const std::string& name, std::size_t components, std::size_t width) {
  Handle property;
  mesh.add_property(property, name);
  mesh.property(property).set_shape(components, width);
  for (const auto e : mesh.template all_elements<typename Handle::Handle>()) {
    fill(mesh.property(property, e), key(mesh, e));
  }
  return property;
}

template <class Mesh, class Handle>
void expect_filled(const Mesh& mesh, Handle property, std::size_t components, std::size_t width) {
  for (const auto e : mesh.template all_elements<typename Handle::Handle>()) {
    ASSERT_TRUE(is_filled(mesh.property(property, e), key(mesh, e), components, width)) << e.idx();
  }
}

//! All numbers of some elements.
template <class Property>
bool is_zero(const Property& property, std::size_t first, std::size_t last) {
  const std::size_t size = property.components() * property.width();
  for (std::size_t k = first * size; k < last * size; ++k) {
    if (property.data()[k] != 0) return false;
  }
  return true;
}

}  // namespace flbc::testing

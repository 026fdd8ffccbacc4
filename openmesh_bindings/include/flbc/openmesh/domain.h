// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Makes the domain mesh of a solve from an OpenMesh mesh or a TetMesh. Vertices, cells, and facets
//! keep the indices of their handles.
#pragma once

#include <string>

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Core/Utils/vector_traits.hh>

#include "flbc/boundary_values.h"
#include "flbc/bounding_box.h"
#include "flbc/domain_mesh.h"
#include "flbc/errors.h"
#include "flbc/openmesh/elements.h"

namespace flbc::openmesh {

//! A domain mesh with its facets.
template <int Dim>
struct Domain {
  DomainMesh<Dim> mesh;        //!< cells have positive orientation
  MeshTopology<Dim> topology;  //!< facets numbered as mesh edges (2D) or faces (3D)
};

namespace internal {

[[noreturn]] inline void refuse_deleted(const char* kind, int index) {
  throw InputError("the mesh has deleted elements, the first is " + std::string(kind) + " " +
                   std::to_string(index) + "; call garbage_collection() first");
}

template <class Mesh>
void refuse_deleted_elements(const Mesh& mesh) {
  if (mesh.has_face_status()) {
    for (const auto f : mesh.all_faces()) {
      if (mesh.status(f).deleted()) refuse_deleted("face", f.idx());
    }
  }
  if (mesh.has_edge_status()) {
    for (const auto e : mesh.all_edges()) {
      if (mesh.status(e).deleted()) refuse_deleted("edge", e.idx());
    }
  }
  if (mesh.has_vertex_status()) {
    for (const auto v : mesh.all_vertices()) {
      if (mesh.status(v).deleted()) refuse_deleted("vertex", v.idx());
    }
  }
}

//! The points; a third coordinate must be constant.
template <class Mesh>
PointList<2> plane_points(const Mesh& mesh) {
  using Point = typename Mesh::Point;
  constexpr int kSize = OpenMesh::vector_traits<Point>::size_;
  static_assert(kSize == 2 || kSize == 3, "points have two or three coordinates");
  PointList<2> points(2, mesh.n_vertices());
  for (const auto v : mesh.vertices()) {
    const Point& point = mesh.point(v);
    points.col(v.idx()) << static_cast<double>(point[0]), static_cast<double>(point[1]);
  }
  if constexpr (kSize == 3) {
    if (mesh.n_vertices() == 0) return points;
    const double size = (points.rowwise().maxCoeff() - points.rowwise().minCoeff()).norm();
    const double height = static_cast<double>(mesh.point(mesh.vertex_handle(0))[2]);
    for (const auto v : mesh.vertices()) {
      const double z = static_cast<double>(mesh.point(v)[2]);
      if (std::abs(z - height) > 1e-9 * size) {
        throw InputError("the mesh is not in a plane z = const: vertex " + std::to_string(v.idx()) +
                         " has z = " + std::to_string(z) +
                         ", vertex 0 has z = " + std::to_string(height));
      }
    }
  }
  return points;
}

}  // namespace internal

//! Makes the domain of a triangle mesh in the plane. Points have two coordinates, or three of which
//! the last is constant.
//! \throws InputError naming the element if the mesh has deleted elements, vertices without faces,
//! or faces without area, or is not a connected domain
template <class Traits>
Domain<2> make_domain(const OpenMesh::TriMesh_ArrayKernelT<Traits>& mesh) {
  internal::refuse_deleted_elements(mesh);
  Domain<2> domain;
  domain.mesh.points = internal::plane_points(mesh);
  domain.mesh.cells.resize(3, mesh.n_faces());
  for (const auto face : mesh.faces()) {
    int k = 0;
    for (const auto vertex : mesh.fv_range(face)) domain.mesh.cells(k++, face.idx()) = vertex.idx();
  }
  normalize_and_validate(domain.mesh);

  auto& topology = domain.topology;
  topology.facets.resize(2, mesh.n_edges());
  topology.sides.resize(2, mesh.n_edges());
  for (const auto edge : mesh.edges()) {
    const auto first = mesh.halfedge_handle(edge, 0);
    const auto second = mesh.halfedge_handle(edge, 1);
    // The face of a boundary edge is on the first side.
    const bool swapped = mesh.is_boundary(first);
    const auto inner = swapped ? second : first;
    const auto outer = swapped ? first : second;
    topology.facets.col(edge.idx()) << mesh.from_vertex_handle(inner).idx(),
        mesh.to_vertex_handle(inner).idx();
    topology.sides.col(edge.idx()) << mesh.face_handle(inner).idx(),
        (mesh.is_boundary(outer) ? -1 : mesh.face_handle(outer).idx());
  }
  topology.cell_facets.resize(3, mesh.n_faces());
  for (const auto face : mesh.faces()) {
    for (const auto halfedge : mesh.fh_range(face)) {
      const Index opposite = mesh.opposite_vh(halfedge).idx();
      for (int k = 0; k < 3; ++k) {
        if (domain.mesh.cells(k, face.idx()) == opposite) {
          topology.cell_facets(k, face.idx()) = mesh.edge_handle(halfedge).idx();
        }
      }
    }
  }
  return domain;
}

//! The faces of a tetrahedral mesh.
Domain<3> make_domain(const TetMesh& mesh);

//! The domain of a mesh. Boundary vertices within kBoundaryTolerance are moved onto the cage,
//! because text formats and default OpenMesh points have single precision.
//! \throws InputError as make_domain()
template <class Mesh, int Dim>
Domain<Dim> snapped_domain(const Mesh& mesh, const Cage<Dim>& cage) {
  auto domain = make_domain(mesh);
  snap_to_cage(cage, domain.topology, kBoundaryTolerance, domain.mesh);
  return domain;
}

}  // namespace flbc::openmesh

// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Converts OpenMesh meshes to cages, domain meshes, and matrices, and back. Elements keep their
//! indices. Coordinates are exact unless the mesh points have single precision.
#pragma once

#include <string>
#include <type_traits>
#include <vector>

#include <OpenMesh/Core/System/omstream.hh>
#include <OpenMesh/Core/Utils/vector_traits.hh>

#include "flbc/cage.h"
#include "flbc/domain_mesh.h"
#include "flbc/errors.h"
#include "flbc/openmesh/domain.h"
#include "flbc/openmesh/tet_mesh.h"

namespace flbc::openmesh {

//! Number of coordinates of mesh points.
template <class Mesh>
inline constexpr int kPointSize =
    static_cast<int>(OpenMesh::vector_traits<typename Mesh::Point>::size_);

//! The points, one column per vertex.
//! \return Dim x V
//! \throws InputError naming the vertex if Dim is 2 and the mesh is not in a plane z = const
template <int Dim, class Mesh>
PointList<Dim> points_of(const Mesh& mesh) {
  if constexpr (Dim == 2) {
    return internal::plane_points(mesh);
  } else {
    static_assert(kPointSize<Mesh> == 3, "the points of this mesh have two coordinates");
    PointList<3> points(3, static_cast<Eigen::Index>(mesh.n_vertices()));
    for (const auto v : mesh.vertices()) {
      const auto& point = mesh.point(v);
      for (int d = 0; d < 3; ++d) points(d, v.idx()) = static_cast<double>(point[d]);
    }
    return points;
  }
}

//! Moves the vertices. With Dim = 2, a third coordinate is unchanged.
//! \param points  Dim x V \throws InputError if their number is not V
template <class Mesh, int Dim>
void set_points(Mesh& mesh, const PointList<Dim>& points) {
  static_assert(kPointSize<Mesh> >= Dim, "the points of this mesh have two coordinates");
  if (points.cols() != static_cast<Eigen::Index>(mesh.n_vertices())) {
    throw InputError(std::to_string(points.cols()) + " points are not those of a mesh with " +
                     std::to_string(mesh.n_vertices()) + " vertices");
  }
  for (const auto v : mesh.vertices()) {
    auto point = mesh.point(v);
    using Coordinate = std::decay_t<decltype(point[0])>;
    for (int d = 0; d < Dim; ++d) point[d] = static_cast<Coordinate>(points(d, v.idx()));
    mesh.set_point(v, point);
  }
}

//! The vertices of each face in their order.
template <class Mesh>
std::vector<std::vector<Index>> polygons_of(const Mesh& mesh) {
  std::vector<std::vector<Index>> polygons;
  polygons.reserve(mesh.n_faces());
  for (const auto face : mesh.faces()) {
    polygons.emplace_back();
    for (const auto vertex : mesh.fv_range(face)) polygons.back().push_back(vertex.idx());
  }
  return polygons;
}

//! The two vertices of each edge. \return 2 x E
template <class Mesh>
Eigen::Matrix<Index, 2, Eigen::Dynamic> edges_of(const Mesh& mesh) {
  Eigen::Matrix<Index, 2, Eigen::Dynamic> edges(2, static_cast<Eigen::Index>(mesh.n_edges()));
  for (const auto edge : mesh.edges()) {
    if constexpr (std::is_same_v<Mesh, TetMesh>) {
      const auto ends = mesh.ev_range(edge);
      edges.col(edge.idx()) << ends[0].idx(), ends[1].idx();
    } else {
      const auto halfedge = mesh.halfedge_handle(edge, 0);
      edges.col(edge.idx()) << mesh.from_vertex_handle(halfedge).idx(),
          mesh.to_vertex_handle(halfedge).idx();
    }
  }
  return edges;
}

namespace internal {

//! Polygons with more than three corners are triangulated as in io::to_cage().
Cage<3> cage_of_polygons(const PointList<3>& points,
                         const std::vector<std::vector<Index>>& polygons);

//! The control points of a cage with one loop in their order around it, counterclockwise.
//! \throws InputError if the cage is defective or has several loops
std::vector<Index> loop_of(const Cage<2>& cage);

[[noreturn]] void refuse_face(const char* kind, Index number);

template <class Mesh, int Dim>
void add_vertices(Mesh& mesh, const PointList<Dim>& points) {
  typename Mesh::Point origin;
  for (int d = 0; d < kPointSize<Mesh>; ++d) origin[d] = 0;
  for (Eigen::Index v = 0; v < points.cols(); ++v) mesh.add_vertex(origin);
  set_points(mesh, points);
}

//! Disables the message streams of OpenMesh during its lifetime. OpenMesh prints errors and byte
//! counts to standard error, and the library must not print.
class SilencedOpenMesh {
 public:
  SilencedOpenMesh() : errors_(omerr().is_enabled()), log_(omlog().is_enabled()) {
    omerr().disable();
    omlog().disable();
  }
  ~SilencedOpenMesh() {
    if (errors_) omerr().enable();
    if (log_) omlog().enable();
  }
  SilencedOpenMesh(const SilencedOpenMesh&) = delete;
  SilencedOpenMesh& operator=(const SilencedOpenMesh&) = delete;

 private:
  bool errors_, log_;  // whether they were enabled before
};

//! \param faces  3 x F
//! \param kind  of the faces, for messages
template <class Mesh>
void add_triangles(Mesh& mesh, const Eigen::Matrix<Index, 3, Eigen::Dynamic>& faces,
                   const char* kind) {
  const SilencedOpenMesh silence;
  for (Index f = 0; f < static_cast<Index>(faces.cols()); ++f) {
    const auto face =
        mesh.add_face(mesh.vertex_handle(faces(0, f)), mesh.vertex_handle(faces(1, f)),
                      mesh.vertex_handle(faces(2, f)));
    if (!face.is_valid()) refuse_face(kind, f);
  }
}

}  // namespace internal

//! A closed surface as a cage: its vertices become control points, its faces facets. Polygons are
//! triangulated. The cage is not validated.
//! \throws InputError if the mesh has deleted elements or is a single polygon
template <class Mesh>
Cage<3> to_cage(const Mesh& mesh) {
  internal::refuse_deleted_elements(mesh);
  return internal::cage_of_polygons(points_of<3>(mesh), polygons_of(mesh));
}

//! The vertices on the boundary loops of a mesh in a plane, ascending: the control points of
//! to_outline().
template <class Mesh>
std::vector<OpenMesh::VertexHandle> outline_vertices(const Mesh& mesh) {
  std::vector<OpenMesh::VertexHandle> vertices;
  for (const auto vertex : mesh.vertices()) {
    if (!mesh.is_isolated(vertex) && mesh.is_boundary(vertex)) vertices.emplace_back(vertex.idx());
  }
  return vertices;
}

//! The boundary loops of a mesh in a plane as a cage; inner ones are holes. Facets have the
//! orientation of the faces.
//! \throws InputError if the mesh has deleted elements or is not in a plane z = const
template <class Mesh>
Cage<2> to_outline(const Mesh& mesh) {
  internal::refuse_deleted_elements(mesh);
  const auto points = points_of<2>(mesh);
  const auto vertices = outline_vertices(mesh);
  std::vector<Index> control_point(mesh.n_vertices(), -1);
  Cage<2> cage;
  cage.points.resize(2, static_cast<Eigen::Index>(vertices.size()));
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    control_point[vertices[i].idx()] = static_cast<Index>(i);
    cage.points.col(i) = points.col(vertices[i].idx());
  }
  std::vector<Eigen::Matrix<Index, 2, 1>> facets;
  for (const auto vertex : vertices) {
    // The halfedges without a face have the opposite orientation.
    for (const auto halfedge : mesh.vih_range(vertex)) {
      if (!mesh.is_boundary(halfedge)) continue;
      facets.emplace_back(control_point[vertex.idx()],
                          control_point[mesh.from_vertex_handle(halfedge).idx()]);
    }
  }
  cage.facets.resize(2, static_cast<Eigen::Index>(facets.size()));
  for (std::size_t f = 0; f < facets.size(); ++f) cage.facets.col(f) = facets[f];
  return cage;
}

//! A mesh of triangles or polygons whose faces are the facets of a cage.
//! \throws InputError naming a defect, or a facet that no half-edge mesh can hold
template <class Mesh>
Mesh to_mesh(const Cage<3>& cage) {
  validate(cage);
  Mesh mesh;
  internal::add_vertices(mesh, cage.points);
  internal::add_triangles(mesh, cage.facets, "facet");
  return mesh;
}

//! One polygon (a mesh of triangles cuts it fanwise). \throws InputError naming a defect, or if the
//! cage has holes or several parts
template <class Mesh>
Mesh to_mesh(const Cage<2>& cage) {
  Mesh mesh;
  internal::add_vertices(mesh, cage.points);
  std::vector<OpenMesh::VertexHandle> corners;
  for (const Index vertex : internal::loop_of(cage)) corners.emplace_back(vertex);
  mesh.add_face(corners);
  return mesh;
}

//! The triangles of a domain mesh. \throws InputError naming a triangle that no half-edge mesh can
//! hold
template <class Mesh>
Mesh to_mesh(const DomainMesh<2>& domain) {
  Mesh mesh;
  internal::add_vertices(mesh, domain.points);
  internal::add_triangles(mesh, domain.cells, "triangle");
  return mesh;
}

//! The tetrahedra of a domain mesh, Mesh = TetMesh. \throws InputError as TetMesh::assign()
template <class Mesh = TetMesh>
TetMesh to_mesh(const DomainMesh<3>& domain) {
  static_assert(std::is_same_v<Mesh, TetMesh>, "a mesh of surfaces holds no tetrahedra");
  return TetMesh::from(domain);
}

//! The domain mesh of a triangle mesh in a plane: its vertices and faces, oriented
//! counterclockwise.
//! \throws InputError as make_domain()
template <class Traits>
DomainMesh<2> to_domain(const OpenMesh::TriMesh_ArrayKernelT<Traits>& mesh) {
  return make_domain(mesh).mesh;
}

//! The domain mesh of a tetrahedral mesh. \throws InputError as make_domain()
inline DomainMesh<3> to_domain(const TetMesh& mesh) {
  DomainMesh<3> domain = mesh.domain();
  normalize_and_validate(domain);
  return domain;
}

namespace internal {

//! edge_list() for vertices at other positions.
template <int Dim, class Mesh>
EdgeList edge_list_at(const Mesh& mesh, const PointList<Dim>& points) {
  if constexpr (std::is_same_v<Mesh, TetMesh>) {
    static_assert(Dim == 3, "tetrahedra are in space");
    return edges_of_cells(DomainMesh<3>{points, mesh.domain().cells});
  } else {
    return edges_of_polygons(points, polygons_of(mesh));
  }
}

}  // namespace internal

//! The edges of a mesh with the weights of edges_of_polygons() or, for tetrahedra,
//! edges_of_cells(). \tparam Dim  of the points
template <int Dim, class Mesh>
EdgeList edge_list(const Mesh& mesh) {
  return internal::edge_list_at<Dim>(mesh, points_of<Dim>(mesh));
}

}  // namespace flbc::openmesh

// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Moves a mesh with its cage by the weights of its vertices.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <type_traits>
#include <vector>

#include "flbc/cage.h"
#include "flbc/openmesh/convert.h"
#include "flbc/openmesh/weights.h"

namespace flbc::openmesh {

//! Options of deform().
struct DeformOptions {
  //! Name of the property of weights, in either form.
  std::string weights = kWeights;

  //! Whether to update the vertex, halfedge, and face normals that the mesh has.
  bool normals = false;

  //! Maximum number of threads; 0: as many as OpenMP offers. Below four million weights (half a
  //! million vertices with 8 influences) one thread is used, because that is faster.
  int threads = 0;
};

namespace internal {

//! The points of a mesh in place: coordinate d of point p is at data[p * stride + d].
template <class Scalar>
struct PointsView {
  Scalar* data;
  std::size_t stride;
};

template <class Mesh>
auto view_points(Mesh& mesh) {
  using Point = typename Mesh::Point;
  using Scalar = typename OpenMesh::vector_traits<Point>::value_type;
  static_assert(std::is_same_v<Scalar, float> || std::is_same_v<Scalar, double>,
                "points have coordinates of float or double");
  static_assert(sizeof(Point) % sizeof(Scalar) == 0, "points are their coordinates");
  Scalar* data = mesh.n_vertices() == 0 ? nullptr : &mesh.point(OpenMesh::VertexHandle(0))[0];
  return PointsView<Scalar>{data, sizeof(Point) / sizeof(Scalar)};
}

//! Whether all weights of a vertex are zero, as those of vertices that were added after bind().
template <class Weight>
bool is_unbound(const InfluencesView<Weight>& influences) {
  return influences.count() == 0;
}
template <class Weight>
bool is_unbound(const RowsView<Weight>& row) {
  return row.matrix().isZero(0);
}

//! Deforms one point per element of `weights` with the control points (Dim x n).
//! \param offsets  Dim values per point to add; may be null
//! \return number of points with neither weights nor an offset
//! \throws InputError if the numbers of control points differ, or no point has weights or an offset
template <class Block, class Scalar, int Dim>
Index move_points(const Block& weights, const PointList<Dim>& control_points,
                  const RowBlock<double>* offsets, int threads, const PointsView<Scalar>& points);

//! \return a unit vector; zero for zero
template <class Normal>
Normal normalized(const Normal& normal) {
  const auto length = norm(normal);
  return length > 0 ? Normal(normal / length) : normal;
}

//! The normals of OpenMesh's update_normals() in half the time: each face is added to its vertices,
//! where OpenMesh walks around each vertex.
template <class Mesh>
void update_normals(Mesh& mesh) {
  if constexpr (!std::is_same_v<Mesh, TetMesh> && kPointSize<Mesh> == 3) {
    using Normal = typename Mesh::Normal;
    const auto corner = [&](auto halfedge) { return mesh.to_vertex_handle(halfedge); };
    // As long as twice the area of the triangle.
    const auto normal_of = [&](auto a, auto b, auto c) {
      return OpenMesh::vector_cast<Normal>(
          cross(mesh.point(b) - mesh.point(a), mesh.point(c) - mesh.point(a)));
    };
    const bool requests_face_normals = mesh.has_halfedge_normals() && !mesh.has_face_normals();
    if (requests_face_normals) mesh.request_face_normals();
    std::vector<Normal> none;
    auto& of_faces =
        mesh.has_face_normals() ? mesh.property(mesh.face_normals_pph()).data_vector() : none;
    auto& of_vertices =
        mesh.has_vertex_normals() ? mesh.property(mesh.vertex_normals_pph()).data_vector() : none;
    std::fill(of_vertices.begin(), of_vertices.end(), Normal(0, 0, 0));
    for (const auto face : mesh.faces()) {
      const auto first = mesh.halfedge_handle(face), second = mesh.next_halfedge_handle(first);
      const auto third = mesh.next_halfedge_handle(second);
      const auto a = corner(first), b = corner(second), c = corner(third);
      const auto each_other_corner = [&](auto take) {
        if (Mesh::is_trimesh()) return;  // saves a tenth of the time
        for (auto h = mesh.next_halfedge_handle(third); h != first;
             h = mesh.next_halfedge_handle(h)) {
          take(corner(h));
        }
      };
      auto normal = normal_of(a, b, c);
      each_other_corner([&, last = c](auto d) mutable {
        normal += normal_of(a, last, d);
        last = d;
      });
      normal = normalized(normal);
      if (!of_faces.empty()) of_faces[face.idx()] = normal;
      if (of_vertices.empty()) continue;
      for (const auto v : {a, b, c}) of_vertices[v.idx()] += normal;
      each_other_corner([&](auto v) { of_vertices[v.idx()] += normal; });
    }
    for (auto& normal : of_vertices) normal = normalized(normal);
    if (mesh.has_halfedge_normals()) mesh.update_halfedge_normals();
    if (requests_face_normals) mesh.release_face_normals();
  }
}

}  // namespace internal

//! Moves mesh points to x = sum_i w_i c_i, plus the offset for points outside the cage at bind().
//! Vertices that stay where they are (kKeep) are unchanged, so that several cages can move parts of
//! a mesh: bind each with another name of the weights, and call this for each. No vertex may be in
//! two of these cages.
//! The current positions have no effect. The third coordinate of a planar mesh is unchanged.
//! Vertices that were not bound, such as those that split() added after bind(), are unchanged; see
//! bind_new_vertices().
//! \param control_points  Dim x n
//! \return number of vertices that were not bound
//! \throws InputError if the mesh has no weights of this name, the number of control points differs,
//! no vertex was bound, or clean() has removed vertices but not their properties
template <class Mesh, int Dim>
Index deform(Mesh& mesh, const PointList<Dim>& control_points, const DeformOptions& options = {}) {
  static_assert(kPointSize<Mesh> >= Dim, "the points of this mesh have two coordinates");
  const auto points = internal::view_points(mesh);
  const auto* offset =
      internal::find_property<Wide<double>>(mesh, internal::name_of_offset(options.weights));
  const auto* offsets = offset ? &offset->data_vector() : nullptr;
  const auto move = [&](const auto& weights) {
    internal::require_vertices(mesh.n_vertices(), weights.size());
    return internal::move_points(weights, control_points, offsets, options.threads, points);
  };
  const auto* influences = internal::find_property<Influences>(mesh, options.weights);
  const Index left = influences ? move(influences->data_vector())
                                : move(weights_property(mesh, options.weights).data_vector());
  if (options.normals) internal::update_normals(mesh);
  return left;
}

//! The same for a posed cage.
template <class Mesh, int Dim>
Index deform(Mesh& mesh, const Cage<Dim>& pose, const DeformOptions& options = {}) {
  return deform(mesh, pose.points, options);
}

//! The same for a cage given as a mesh: a surface whose vertices are the control points, or a
//! planar mesh whose boundary is the cage (points with two coordinates).
template <class Mesh, class CageMesh>
Index deform(Mesh& mesh, const CageMesh& pose, const DeformOptions& options = {}) {
  if constexpr (kPointSize<CageMesh> == 2) {
    return deform(mesh, to_outline(pose).points, options);
  } else {
    return deform(mesh, points_of<3>(pose), options);
  }
}

}  // namespace flbc::openmesh

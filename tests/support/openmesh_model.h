// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Models written and read by OpenMesh alone, as a reference for what our readers and writers do
//! with them.
#pragma once

#include <OpenMesh/Core/IO/MeshIO.hh>
#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>

#include "flbc/types.h"
#include "support/test.h"

namespace flbc::testing {

//! Double points, and all attributes per vertex.
struct OpenMeshTraits : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;
  using Normal = OpenMesh::Vec3d;
  using Color = OpenMesh::Vec3uc;
  VertexAttributes(OpenMesh::Attributes::Normal | OpenMesh::Attributes::Color |
                   OpenMesh::Attributes::TexCoord2D);
  FaceAttributes(OpenMesh::Attributes::Normal);
};
using OpenMeshModel = OpenMesh::PolyMesh_ArrayKernelT<OpenMeshTraits>;

//! All that a vertex has.
inline OpenMesh::IO::Options all_attributes() {
  using OpenMesh::IO::Options;
  return Options(Options::VertexNormal | Options::VertexColor | Options::VertexTexCoord);
}

//! A box without lid, inside the tetrahedron of the origin and the three unit vectors: five
//! quadrilaterals, and a triangle that sticks out of one. Coordinates are multiples of 1/16, so
//! that single precision holds them and weights of the tetrahedron reproduce them exactly.
inline OpenMeshModel box_with_attributes() {
  OpenMeshModel mesh;
  std::vector<OpenMesh::VertexHandle> v;
  for (int k = 0; k < 8; ++k) {
    v.push_back(mesh.add_vertex(
        {0.125 + 0.125 * (k & 1), 0.0625 + 0.0625 * (k & 2), 0.25 + 0.03125 * (k & 4)}));
  }
  v.push_back(mesh.add_vertex({0.375, 0.0625, 0.5}));
  mesh.add_face({v[0], v[2], v[3], v[1]});
  mesh.add_face({v[0], v[1], v[5], v[4]});
  mesh.add_face({v[1], v[3], v[7], v[5]});
  mesh.add_face({v[3], v[2], v[6], v[7]});
  mesh.add_face({v[2], v[0], v[4], v[6]});
  mesh.add_face({v[5], v[7], v[8]});
  mesh.update_normals();
  for (const auto vertex : mesh.vertices()) {
    const auto k = static_cast<unsigned char>(vertex.idx());
    mesh.set_color(vertex,
                   {static_cast<unsigned char>(10 * k), 200, static_cast<unsigned char>(255 - k)});
    mesh.set_texcoord2D(vertex, {0.125f * k, 1.0f / (1.0f + k)});
  }
  return mesh;
}

//! The same, pressed into the plane z = 0.75 so that no two vertices coincide.
inline OpenMeshModel flat_box_with_attributes() {
  auto mesh = box_with_attributes();
  for (const auto vertex : mesh.vertices()) {
    auto& point = mesh.point(vertex);
    const double height = point[2] - 0.25;
    point = {point[0] + 0.5 * height, point[1] + 0.25 * height, 0.75};
  }
  return mesh;
}

//! Writes a mesh as OpenMesh does.
inline void write_by_openmesh(const OpenMeshModel& mesh, const std::string& path,
                              OpenMesh::IO::Options options = all_attributes()) {
  omlog().disable();
  ASSERT_TRUE(OpenMesh::IO::write_mesh(mesh, path, options)) << path;
  omlog().enable();
}

//! Reads one, and fails the test if there are not all attributes that are wanted.
inline OpenMeshModel read_by_openmesh(const std::string& path,
                                      OpenMesh::IO::Options wanted = all_attributes()) {
  OpenMeshModel mesh;
  auto options = wanted;
  EXPECT_TRUE(OpenMesh::IO::read_mesh(mesh, path, options)) << path;
  EXPECT_TRUE(!wanted.vertex_has_normal() || options.vertex_has_normal()) << path;
  EXPECT_TRUE(!wanted.vertex_has_color() || options.vertex_has_color()) << path;
  EXPECT_TRUE(!wanted.vertex_has_texcoord() || options.vertex_has_texcoord()) << path;
  return mesh;
}

//! 3 x number of vertices.
inline PointList<3> points_of(const OpenMeshModel& mesh) {
  PointList<3> points(3, mesh.n_vertices());
  for (const auto v : mesh.vertices()) {
    for (int d = 0; d < 3; ++d) points(d, v.idx()) = mesh.point(v)[d];
  }
  return points;
}

//! That two meshes have the same faces: the same vertices in the same order round.
inline void expect_same_faces(const OpenMeshModel& a, const OpenMeshModel& b) {
  ASSERT_EQ(a.n_vertices(), b.n_vertices());
  ASSERT_EQ(a.n_faces(), b.n_faces());
  for (const auto face : a.faces()) {
    std::vector<int> corners, others;
    for (const auto v : a.fv_range(face)) corners.push_back(v.idx());
    for (const auto v : b.fv_range(face)) others.push_back(v.idx());
    ASSERT_EQ(corners.size(), others.size());
    const auto first = std::find(others.begin(), others.end(), corners.front());
    std::rotate(others.begin(), first, others.end());
    EXPECT_EQ(corners, others) << "face " << face.idx();
  }
}

//! That two meshes have the same of what `options` names: colors and texture coordinates.
inline void expect_same_paint(const OpenMeshModel& a, const OpenMeshModel& b,
                              const OpenMesh::IO::Options& options = all_attributes()) {
  ASSERT_EQ(a.n_vertices(), b.n_vertices());
  for (const auto v : a.vertices()) {
    EXPECT_TRUE(!options.vertex_has_color() || a.color(v) == b.color(v)) << "vertex " << v.idx();
    EXPECT_TRUE(!options.vertex_has_texcoord() ||
                (a.texcoord2D(v) - b.texcoord2D(v)).norm() < 1e-6f)
        << "vertex " << v.idx();
  }
}

}  // namespace flbc::testing

// SPDX-License-Identifier: BSD-3-Clause
// Component openmesh: a cage from a file, and coordinates on a half-edge mesh that follows it.
#include <fstream>

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>

#include <flbc/io/cage_io.h>
#include <flbc/io/model_file.h>
#include <flbc/openmesh/bind.h>
#include <flbc/openmesh/lbc.h>

#include "judge.h"

namespace {

flbc::Cage<2> read_square() {
  const char* const path = "square.ply";
  std::ofstream(path) << "ply\nformat ascii 1.0\nelement vertex 4\nproperty double x\n"
                         "property double y\nproperty double z\nelement face 1\n"
                         "property list uchar int vertex_indices\nend_header\n"
                         "0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n";
  const auto soup = flbc::io::read_polygons(path);
  return std::get<flbc::Cage<2>>(flbc::io::to_cage(soup, path));
}

}  // namespace

int main() {
  const auto cage = read_square();
  OpenMesh::TriMesh_ArrayKernelT<> mesh;
  flbc::PointList<2> points(2, 5);
  points << cage.points, Eigen::Vector2d(0.25, 0.5);
  for (const auto& point : points.colwise()) {
    mesh.add_vertex({static_cast<float>(point.x()), static_cast<float>(point.y()), 0});
  }
  for (int k = 0; k < 4; ++k) {
    mesh.add_face(mesh.vertex_handle(k), mesh.vertex_handle((k + 1) % 4), mesh.vertex_handle(4));
  }
  flbc::openmesh::solve(mesh, cage);
  const int fine = judge<2>(cage, points, flbc::openmesh::get_weights(mesh).dense());
  // With a given mesh, no other component is needed.
  flbc::openmesh::bind(mesh, cage, flbc::openmesh::to_domain(mesh));
  flbc::openmesh::deform(mesh, cage);
  return fine + judge<2>(cage, points, flbc::openmesh::get_weights(mesh).dense());
}

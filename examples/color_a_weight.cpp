// SPDX-License-Identifier: BSD-3-Clause
// Solves on a triangulated 2D shape and colors its vertices by one weight.
//   color_a_weight CAGE.obj SHAPE.obj CONTROL_POINT OUT.off
#include <iostream>

#include <OpenMesh/Core/IO/MeshIO.hh>
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>

#include <flbc/io/cage_io.h>
#include <flbc/io/mesh_io.h>
#include <flbc/io/model_file.h>
#include <flbc/openmesh/lbc.h>

struct Traits : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;
  VertexAttributes(OpenMesh::Attributes::Color);
};
using Mesh = OpenMesh::TriMesh_ArrayKernelT<Traits>;

int main(int argc, char** argv) try {
  if (argc != 5) {
    std::cerr << "usage: color_a_weight CAGE.obj SHAPE.obj CONTROL_POINT OUT.off\n";
    return 1;
  }
  // Exact coordinates: the readers of OpenMesh keep single precision.
  const auto cage =
      std::get<flbc::Cage<2>>(flbc::io::to_cage(flbc::io::read_polygons(argv[1]), argv[1]));
  auto mesh = flbc::openmesh::to_mesh<Mesh>(flbc::io::read_domain<2>(argv[2]));
  const auto report = flbc::openmesh::solve(mesh, cage);

  OpenMesh::VProp<flbc::openmesh::Wide<double>> weights(mesh, flbc::openmesh::kWeights);
  const auto control_point = static_cast<std::size_t>(std::stoi(argv[3]));
  for (const auto vertex : mesh.vertices()) {
    const double weight = weights[vertex][control_point];
    const auto fade = static_cast<unsigned char>(255 * (1 - weight));
    mesh.set_color(vertex, Mesh::Color(255, fade, fade));
  }
  std::cout << report.iterations << " iterations, " << report.quality.mean_influences
            << " control points influence a vertex\n";
  return OpenMesh::IO::write_mesh(mesh, argv[4], OpenMesh::IO::Options::VertexColor) ? 0 : 4;
} catch (const std::exception& error) {
  std::cerr << error.what() << '\n';
  return 2;
}

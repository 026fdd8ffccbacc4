// SPDX-License-Identifier: BSD-3-Clause
// Iterates on a triangulated 2D shape and reads gradients, duals, and weights from the mesh.
//   iterate_on_mesh CAGE.obj SHAPE.obj CONTROL_POINT OUT.off
#include <flbc/io/cage_io.h>
#include <flbc/io/mesh_io.h>
#include <flbc/io/model_file.h>
#include <flbc/openmesh/convert.h>
#include <flbc/openmesh/gradient_admm.h>
#include <OpenMesh/Core/IO/MeshIO.hh>
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <iostream>

struct Traits : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;
  VertexAttributes(OpenMesh::Attributes::Color);
};
using Mesh = OpenMesh::TriMesh_ArrayKernelT<Traits>;

int main(int argc, char** argv) try {
  if (argc != 5) throw flbc::InputError("usage: iterate_on_mesh CAGE SHAPE CONTROL_POINT OUT.off");
  const auto any_cage = flbc::io::to_cage(flbc::io::read_polygons(argv[1]), argv[1]);
  auto mesh = flbc::openmesh::to_mesh<Mesh>(flbc::io::read_domain<2>(argv[2]));
  const auto i = static_cast<unsigned>(std::stoi(argv[3]));
  flbc::openmesh::GradientAdmm<Mesh> admm(mesh, std::get<flbc::Cage<2>>(any_cage), {0, 1.8});
  for (int k = 0; k < 10; ++k) std::cout << admm.iterate(30).primal << " residual\n";
  double sum = 0;
  for (const auto f : mesh.faces()) sum -= admm.gradient(f).cwiseProduct(admm.cell_dual(f)).sum();
  std::cout << sum << " objective, " << admm.facet_dual(mesh.edge_handle(0)) << " dual of edge 0\n";
  admm.recover_weights();
  OpenMesh::VProp<flbc::openmesh::Wide<double>> weights(mesh, flbc::openmesh::kWeights);
  for (const auto v : mesh.vertices()) {
    const auto fade = static_cast<unsigned char>(255 * std::clamp(1 - weights[v][i], 0.0, 1.0));
    mesh.set_color(v, Mesh::Color(255, fade, fade));
  }
  return OpenMesh::IO::write_mesh(mesh, argv[4], OpenMesh::IO::Options::VertexColor) ? 0 : 4;
} catch (const std::exception& error) {
  std::cerr << error.what() << '\n';
  return 2;
}

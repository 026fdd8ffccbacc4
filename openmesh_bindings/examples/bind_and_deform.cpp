// SPDX-License-Identifier: BSD-3-Clause
// Binds a model to a cage and deforms it with a posed cage. Reads all OpenMesh formats.
#include <iostream>

#include <flbc/openmesh/bind.h>
#include <OpenMesh/Core/IO/MeshIO.hh>
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>

int main(int argc, char** argv) try {
  OpenMesh::TriMesh_ArrayKernelT<> cage, model, pose;
  using namespace OpenMesh::IO;
  if (argc != 5 || !read_mesh(cage, argv[1]) || !read_mesh(model, argv[2]) ||
      !read_mesh(pose, argv[3])) {
    std::cerr << "usage: bind_and_deform CAGE MODEL POSE OUT\n";
    return 1;
  }
  const auto report = flbc::openmesh::bind(model, cage);
  flbc::openmesh::deform(model, pose);
  std::cout << report.solve.iterations << " iterations, " << report.quality.mean_influences
            << " influences per vertex\n";
  return write_mesh(model, argv[4]) ? 0 : 4;
} catch (const std::exception& error) {
  std::cerr << error.what() << '\n';
  return 2;
}

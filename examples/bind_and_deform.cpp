// SPDX-License-Identifier: BSD-3-Clause
// Binds a model to a cage, and animates it to a pose of the cage. Reads all OpenMesh formats.
//   bind_and_deform CAGE MODEL POSE OUT
#include <chrono>
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
  std::cout << report.quality.mean_influences << " influences per vertex\n"
            << report.mesh_seconds + report.solve_seconds + report.sparsify_seconds
            << " s to bind\n";

  const auto rest = cage;
  constexpr int kFrames = 24;
  const auto begin = std::chrono::steady_clock::now();
  for (int frame = 1; frame <= kFrames; ++frame) {
    const auto part = static_cast<float>(frame) / kFrames;
    for (const auto v : cage.vertices()) {
      cage.set_point(v, rest.point(v) * (1 - part) + pose.point(v) * part);
    }
    flbc::openmesh::deform(model, cage);
  }
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
  std::cout << 1000 * took.count() / kFrames << " ms per frame\n";
  return write_mesh(model, argv[4]) ? 0 : 4;
} catch (const std::exception& error) {
  std::cerr << error.what() << '\n';
  return 2;
}

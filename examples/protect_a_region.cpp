// SPDX-License-Identifier: BSD-3-Clause
// Binds a model so that one end of its cage never moves the half of the model at the other end.
//   protect_a_region CAGE MODEL POSE OUT
#include <algorithm>
#include <iostream>

#include <flbc/openmesh/bind.h>
#include <OpenMesh/Core/IO/MeshIO.hh>
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>

int main(int argc, char** argv) try {
  OpenMesh::TriMesh_ArrayKernelT<> cage, model, pose;
  using namespace OpenMesh::IO;
  if (argc != 5 || !read_mesh(cage, argv[1]) || !read_mesh(model, argv[2]) ||
      !read_mesh(pose, argv[3])) {
    std::cerr << "usage: protect_a_region CAGE MODEL POSE OUT\n";
    return 1;
  }
  float low = cage.point(*cage.vertices_begin())[0], high = low;
  for (const auto v : cage.vertices()) {
    low = std::min(low, cage.point(v)[0]);
    high = std::max(high, cage.point(v)[0]);
  }
  flbc::Mask mask;  // these control points get weights of exactly 0 at these vertices
  for (const auto v : cage.vertices()) {
    if (cage.point(v)[0] > low + 0.8F * (high - low)) mask.control_points.push_back(v.idx());
  }
  for (const auto v : model.vertices()) {
    if (model.point(v)[0] < low + 0.5F * (high - low)) mask.points.push_back(v.idx());
  }
  flbc::openmesh::BindOptions options;
  options.masks = {mask};
  flbc::openmesh::bind(model, cage, options);

  flbc::openmesh::deform(model, cage);
  const auto rest = model;
  for (const int i : mask.control_points) {
    cage.set_point(cage.vertex_handle(i), pose.point(pose.vertex_handle(i)));
  }
  flbc::openmesh::deform(model, cage);
  std::size_t moved = 0;
  for (const int v : mask.points) {
    moved += model.point(model.vertex_handle(v)) != rest.point(rest.vertex_handle(v));
  }
  std::cout << moved << " of " << mask.points.size() << " protected vertices have moved\n";
  return write_mesh(model, argv[4]) ? 0 : 4;
} catch (const std::exception& error) {
  std::cerr << error.what() << '\n';
  return 2;
}

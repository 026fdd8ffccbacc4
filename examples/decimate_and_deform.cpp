// SPDX-License-Identifier: BSD-3-Clause
// A property pipeline: weights of a model, decimation by OpenMesh, which keeps them, and a
// deformation.
//   decimate_and_deform CAGE.obj MODEL.obj OUT.off
#include <cmath>
#include <iostream>

#include <Eigen/Geometry>

#include <OpenMesh/Core/IO/MeshIO.hh>
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Tools/Decimater/DecimaterT.hh>
#include <OpenMesh/Tools/Decimater/ModQuadricT.hh>

#include <flbc/cell_locator.h>
#include <flbc/io/cage_io.h>
#include <flbc/io/model_file.h>
#include <flbc/meshing.h>
#include <flbc/openmesh/lbc.h>
#include <flbc/quality.h>

struct Traits : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;
  using Normal = OpenMesh::Vec3d;
};
using Mesh = OpenMesh::TriMesh_ArrayKernelT<Traits>;

// A twist about the z axis, growing with height.
flbc::Cage<3> twist(flbc::Cage<3> cage) {
  for (Eigen::Index i = 0; i < cage.points.cols(); ++i) {
    const double angle = 0.5 * cage.points(2, i);
    cage.points.col(i) =
        Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ()) * Eigen::Vector3d(cage.points.col(i));
  }
  return cage;
}

int main(int argc, char** argv) try {
  if (argc != 4) {
    std::cerr << "usage: decimate_and_deform CAGE.obj MODEL.obj OUT.off\n";
    return 1;
  }
  const auto cage =
      std::get<flbc::Cage<3>>(flbc::io::to_cage(flbc::io::read_polygons(argv[1]), argv[1]));
  Mesh model;
  if (!OpenMesh::IO::read_mesh(model, argv[2])) return 4;

  // Coordinates on a mesh of the cage's interior, interpolated at the model's vertices.
  const auto domain = flbc::tetrahedralize(cage, {2000});
  const auto solution = flbc::solve(cage, domain);
  const auto points = flbc::openmesh::points_of<3>(model);
  flbc::openmesh::set_weights(
      model, flbc::interpolate(domain, solution.weights, flbc::locate_points(domain, points)));

  // OpenMesh's decimater moves vertices nowhere, so that their weights stay right; collecting the
  // garbage moves rows to where their vertices are.
  const auto before = model.n_vertices();
  OpenMesh::Decimater::DecimaterT<Mesh> decimater(model);
  OpenMesh::Decimater::ModQuadricT<Mesh>::Handle quadric;
  decimater.add(quadric);
  decimater.module(quadric).unset_max_err();
  decimater.initialize();
  decimater.decimate_to(before / 2);
  model.garbage_collection();

  flbc::openmesh::deform(model, twist(cage));
  std::cout << before << " vertices, " << model.n_vertices() << " after decimation\n";
  return OpenMesh::IO::write_mesh(model, argv[3]) ? 0 : 4;
} catch (const std::exception& error) {
  std::cerr << error.what() << '\n';
  return 2;
}

// SPDX-License-Identifier: BSD-3-Clause
// Makes a TetMesh of a cage with the model vertices as mesh vertices. The weights are properties
// without interpolation and deform the model.
//   embedded_surface CAGE.obj MODEL.obj OUT.off
#include <iostream>

#include <OpenMesh/Core/IO/MeshIO.hh>
#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>

#include <flbc/io/cage_io.h>
#include <flbc/io/model_file.h>
#include <flbc/meshing.h>
#include <flbc/openmesh/lbc.h>

struct Traits : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;
};
using Model = OpenMesh::PolyMesh_ArrayKernelT<Traits>;

int main(int argc, char** argv) try {
  if (argc != 4) {
    std::cerr << "usage: embedded_surface CAGE.obj MODEL.obj OUT.off\n";
    return 1;
  }
  const auto cage =
      std::get<flbc::Cage<3>>(flbc::io::to_cage(flbc::io::read_polygons(argv[1]), argv[1]));
  Model model;
  if (!OpenMesh::IO::read_mesh(model, argv[2])) return 4;

  flbc::MeshingOptions<3> meshing;  // the minimum that element quality allows
  meshing.embedded_points = flbc::openmesh::points_of<3>(model);
  auto mesh = flbc::openmesh::TetMesh::from(flbc::tetrahedralize(cage, meshing));
  const auto report = flbc::openmesh::solve(mesh, cage);

  // The mesher puts control points first, then the embedded ones.
  const auto weights = flbc::openmesh::get_weights(mesh).dense();
  flbc::openmesh::set_weights(model,
                              weights.middleCols(cage.size(), meshing.embedded_points.cols()));

  auto pose = cage;
  pose.points.row(2) *= 1.5;
  flbc::openmesh::deform(model, pose);
  std::cout << mesh.n_cells() << " tetrahedra, " << mesh.n_faces() << " faces, "
            << report.iterations << " iterations, smallest weight " << report.quality.min_weight
            << '\n';
  return OpenMesh::IO::write_mesh(model, argv[3]) ? 0 : 4;
} catch (const std::exception& error) {
  std::cerr << error.what() << '\n';
  return 2;
}

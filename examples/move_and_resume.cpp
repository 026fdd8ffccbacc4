// SPDX-License-Identifier: BSD-3-Clause
// A solver that resumes with a smaller tolerance, and then moves the cage at rest. Prints the
// iterations of each solve, and how exactly the last weights reproduce the mesh.
//   move_and_resume CAGE.obj
#include <iostream>

#include <flbc/flbc.h>
#include <flbc/io/cage_io.h>
#include <flbc/io/model_file.h>
#include <flbc/solver.h>

int main(int argc, char** argv) try {
  if (argc != 2) throw flbc::InputError("usage: move_and_resume CAGE.obj");
  const auto cage =
      std::get<flbc::Cage<2>>(flbc::io::to_cage(flbc::io::read_polygons(argv[1]), argv[1]));

  flbc::SolverOptions options;
  options.tolerance = 1e-5;
  flbc::Solver<2> solver(cage, flbc::triangulate(cage, {1500}), options);
  std::cout << solver.solve().report.iterations << '\n';

  options.tolerance = 1e-8;
  solver.set_options(options);
  std::cout << solver.solve().report.iterations << '\n';  // only those that are left

  flbc::PointList<2> wider = cage.points;
  wider.row(0) *= 1.1;
  const flbc::Solution& moved = solver.reshape(wider);  // starts from the state before
  std::cout << moved.report.iterations << '\n'
            << moved.report.quality.max_reproduction_error << '\n';
  return moved.report.status == flbc::SolveStatus::kConverged ? 0 : 3;
} catch (const flbc::Error& error) {
  std::cerr << error.what() << '\n';
  return 2;
}

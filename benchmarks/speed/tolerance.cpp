// SPDX-License-Identifier: BSD-3-Clause
// Whether Method::kValue keeps its promise: for real cages and tolerances, the true mean squared
// error of the weights, against a long run in double precision, relative to the tolerance.
//
//   flbc_bench_tolerance MODELS_FOLDER [--model NAME] [--iterations K] [--start cold|warm]
//
// Per tolerance: iterations, and error / tolerance, which must not exceed 3. K is of the reference.
// A warm start is one from a mesh with a third of the vertices, whether it pays or not.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <variant>

#include "flbc/flbc.h"
#include "flbc/io/cage_io.h"
#include "flbc/io/model_file.h"
#include "speed/real_models.h"

namespace {

using namespace flbc;
using namespace flbc::bench;

constexpr Case kCases[] = {
    {"woody", "2d/woody-control-edgeset.obj", 2000},
    {"woody", "2d/woody-control-edgeset.obj", 7000},
    {"cactus", "2d/cactus-control-edgeset.obj", 2000},
    {"cactus", "2d/cactus-control-edgeset.obj", 7000},
    {"logo", "2d/LBClogo-control-edgeset.obj", 2000},
    {"logo", "2d/LBClogo-control-edgeset.obj", 7000},
    {"horse", "3d/horse_cage.obj", 2000},
    {"horse", "3d/horse_cage.obj", 6000},
    {"armadillo", "3d/armadillo_cage.obj", 4100},
    {"armadillo", "3d/armadillo_cage.obj", 6600},
    {"shark", "3d/shark_cage.obj", 2000},
    {"shark", "3d/shark_cage.obj", 6000},
    {"shark", "3d/shark_cage.obj", 20000},
    {"beast", "3d/beast_cage.obj", 2000},
    {"beast", "3d/beast_cage.obj", 6000},
    {"arm", "3d/arm_cage.obj", 2500},
    {"arm", "3d/arm_cage.obj", 6500},
    {"clothing", "3d/clothing_cage.obj", 3000},
    {"clothing", "3d/clothing_cage.obj", 6500},
};

constexpr double kTolerances[] = {1e-4, 1e-5, 1e-6, 1e-7, 1e-8};

struct Totals {
  double worst = 0;
  double log_sum = 0;
  int iterations = 0;
  int runs = 0;
};

struct Arguments {
  std::string only_model;  // empty: all
  int reference_iterations = 3000;
  bool warm = false;
};

template <int Dim>
Solution solve_from(bool warm, const LbcProblem<Dim>& problem, SolverOptions options) {
  if (!warm) return solve(problem, options);
  options.coarse_levels.factor = 3;
  options.coarse_levels.coarsest = problem.mesh.num_vertices() / 4;  // one level
  return solve(problem, options,
               [](const Cage<Dim>& cage, Index vertices) { return mesh_of(cage, vertices); });
}

template <int Dim>
void run(const Case& test, const Cage<Dim>& cage, const Arguments& arguments, Totals& totals) {
  const auto problem = make_problem(cage, mesh_of(cage, test.vertices), DistanceScheme::kSquare);
  SolverOptions options;
  options.precision = Precision::kDouble;
  options.tolerance = 1e-100;
  options.max_iterations = arguments.reference_iterations;
  const auto reference = solve(problem, options).weights;
  std::printf("%-10s %4d %6d", test.name, problem.num_control_points(),
              problem.mesh.num_vertices());
  for (const double tolerance : kTolerances) {
    options = {};
    options.tolerance = tolerance;
    const auto solution = solve_from(arguments.warm, problem, options);
    const double ratio = squared_error(problem, solution.weights, reference) / tolerance;
    std::printf("  %5d %6.3f", solution.report.iterations, ratio);
    totals.worst = std::max(totals.worst, ratio);
    totals.log_sum += std::log10(std::max(ratio, 1e-3));
    totals.iterations += solution.report.iterations;
    ++totals.runs;
  }
  std::printf("\n");
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2 || argc % 2 != 0) {
    std::fprintf(stderr,
                 "usage: %s MODELS_FOLDER [--model NAME] [--iterations K] [--start cold|warm]\n",
                 argv[0]);
    return 1;
  }
  try {
    Arguments arguments;
    for (int k = 2; k < argc; k += 2) {
      const std::string name = argv[k];
      if (name == "--model") {
        arguments.only_model = argv[k + 1];
      } else if (name == "--iterations") {
        arguments.reference_iterations = std::stoi(argv[k + 1]);
      } else if (name == "--start") {
        arguments.warm = std::string(argv[k + 1]) == "warm";
      } else {
        throw std::invalid_argument("unknown option " + name);
      }
    }
    std::printf("%-10s %4s %6s", "model", "n", "V");
    for (const double tolerance : kTolerances) std::printf("  %5.0e  ratio", tolerance);
    std::printf("\n");
    Totals totals;
    for_each_case(argv[1], kCases, arguments.only_model, [&](const Case& test, const auto& path) {
      const auto cage = io::to_cage(io::read_polygons(path), path);
      std::visit([&](const auto& any) { run(test, any, arguments, totals); }, cage);
    });
    std::printf("worst ratio %.2f, geometric mean %.2f, %d iterations in all\n", totals.worst,
                std::pow(10, totals.log_sum / std::max(1, totals.runs)), totals.iterations);
    return totals.worst <= 3 ? 0 : 1;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}

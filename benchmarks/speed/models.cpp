// SPDX-License-Identifier: BSD-3-Clause
// Solves real cages and prints, for each: iterations, time per iteration, time of the stages,
// memory and the quality of the weights.
//
//   flbc_bench_models MODELS_FOLDER [--threads T] [--method value|gradient|paper|lbc2014|harmonic]
//   [--tolerance T]
//                     [--model NAME] [--reference K] [--linear-solver direct|multigrid]
//                     [--vertices N]
//
// With --reference, the last column is the paper's error (5), the mean squared difference inside,
// from K iterations of method value in double precision.
//
// Each case runs in a process of its own, so that its peak memory is its own.
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <map>
#include <stdexcept>
#include <string>

#include "flbc/flbc.h"
#include "flbc/io/cage_io.h"
#include "flbc/io/model_file.h"
#include "speed/real_models.h"

namespace {

using namespace flbc;
using namespace flbc::bench;

constexpr Case kCases[] = {
    {"woody", "2d/woody-control-edgeset.obj", 10800},
    {"cactus", "2d/cactus-control-edgeset.obj", 10800},
    {"logo", "2d/LBClogo-control-edgeset.obj", 26800},
    {"horse", "3d/horse_cage.obj", 5900},
    {"armadillo", "3d/armadillo_cage.obj", 6600},
    {"shark", "3d/shark_cage.obj", 6000},
    {"beast", "3d/beast_cage.obj", 6000},
    {"horse-40k", "3d/horse_cage.obj", 40000},
};

double peak_mebibytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024;
}

struct Arguments {
  SolverOptions options;
  std::string only_model;        // empty: all
  int reference_iterations = 0;  // 0: no reference
  Index vertices = 0;            // 0: by model
};

// The error (5) of the paper against a long run.
template <int Dim>
double error_to_reference(const LbcProblem<Dim>& problem, const WeightMatrix& weights,
                          int iterations) {
  SolverOptions options;
  options.method = Method::kValue;
  options.precision = Precision::kDouble;
  options.tolerance = 1e-100;
  options.max_iterations = iterations;
  const auto reference = solve(problem, options).weights;
  return squared_error(problem, weights, reference);
}

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

template <int Dim>
void run(const Case& test, const Cage<Dim>& cage, const Arguments& arguments) {
  const auto start = std::chrono::steady_clock::now();
  const auto mesh = mesh_of(cage, arguments.vertices > 0 ? arguments.vertices : test.vertices);
  const double mesh_seconds = seconds_since(start);
  const auto before_setup = std::chrono::steady_clock::now();
  const auto problem = make_problem(cage, mesh, arguments.options.phi);
  const double setup_seconds = seconds_since(before_setup);
  const auto solution = solve(problem, arguments.options);
  const auto& report = solution.report;
  std::printf("%-10s %4d %7d %8d %6d %8.2f %6.2f %6.2f %7.2f %7.2f %8.1f %8.0f %10.2e %9.1e %6.2f",
              test.name, report.control_points, report.vertices, report.cells, report.iterations,
              1000 * report.seconds.solve / report.iterations, mesh_seconds, setup_seconds,
              report.seconds.solve, report.seconds.recover, report.state_scalars_per_cell,
              peak_mebibytes(), report.quality.min_weight, report.quality.max_reproduction_error,
              report.quality.mean_influences);
  if (arguments.reference_iterations > 0) {
    std::printf(" %9.1e",
                error_to_reference(problem, solution.weights, arguments.reference_iterations));
  }
  std::printf("%s\n", report.status == SolveStatus::kConverged ? "" : "  NOT CONVERGED");
  std::fflush(stdout);
}

const std::map<std::string, Method> kMethods{{"value", Method::kValue},
                                             {"gradient", Method::kGradient},
                                             {"paper", Method::kPaper},
                                             {"lbc2014", Method::kLbc2014},
                                             {"harmonic", Method::kHarmonic}};

const std::map<std::string, LinearSolver> kSolvers{{"auto", LinearSolver::kAuto},
                                                   {"direct", LinearSolver::kDirect},
                                                   {"multigrid", LinearSolver::kMultigrid}};

Arguments parse(int argc, char** argv) {
  Arguments arguments;
  for (int k = 2; k < argc; k += 2) {
    const std::string name = argv[k];
    const std::string value = k + 1 < argc ? argv[k + 1] : "";
    if (name == "--threads") {
      arguments.options.threads = std::stoi(value);
    } else if (name == "--tolerance") {
      arguments.options.tolerance = std::stod(value);
    } else if (name == "--method" && kMethods.count(value) > 0) {
      arguments.options.method = kMethods.at(value);
    } else if (name == "--model" && !value.empty()) {
      arguments.only_model = value;
    } else if (name == "--linear-solver" && kSolvers.count(value) > 0) {
      arguments.options.linear_solver = kSolvers.at(value);
    } else if (name == "--vertices") {
      arguments.vertices = std::stoi(value);
    } else if (name == "--reference") {
      arguments.reference_iterations = std::stoi(value);
    } else {
      throw std::invalid_argument("unknown option " + name + " " + value);
    }
  }
  return arguments;
}

// \return true if the case ended well
bool run_isolated(const Case& test, const std::string& path, const Arguments& arguments) {
  const pid_t child = fork();
  if (child == 0) {
    try {
      const auto cage = io::to_cage(io::read_polygons(path), path);
      std::visit([&](const auto& any) { run(test, any, arguments); }, cage);
      std::_Exit(EXIT_SUCCESS);
    } catch (const std::exception& error) {
      std::fprintf(stderr, "%s: %s\n", test.name, error.what());
      std::_Exit(EXIT_FAILURE);
    }
  }
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    std::fprintf(
        stderr,
        "usage: %s MODELS_FOLDER [--threads T] [--method M] [--tolerance T] [--model NAME] "
        "[--reference K]\n",
        argv[0]);
    return 1;
  }
  try {
    const auto arguments = parse(argc, argv);
    std::printf("%-10s %4s %7s %8s %6s %8s %6s %6s %7s %7s %8s %8s %10s %9s %6s", "model", "n", "V",
                "cells", "its", "ms/it", "mesh s", "setup", "solve s", "recover", "num/cell", "MiB",
                "min w", "repro", "infl");
    std::printf("%s\n", arguments.reference_iterations > 0 ? "     error" : "");
    std::fflush(stdout);
    bool ok = true;
    for_each_case(argv[1], kCases, arguments.only_model, [&](const Case& test, const auto& path) {
      ok = run_isolated(test, path, arguments) && ok;
    });
    return ok ? 0 : 1;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}

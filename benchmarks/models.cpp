// SPDX-License-Identifier: BSD-3-Clause
// Solves real cages and prints, for each: iterations, time per iteration, time of the stages,
// memory and the quality of the weights.
//
//   flbc_bench_models MODELS_FOLDER [--threads T] [--method gradient|paper] [--tolerance T]
//
// Each case runs in a process of its own, so that its peak memory is its own.
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <stdexcept>
#include <string>

#include "flbc/flbc.h"
#include "flbc/io/cage_io.h"

namespace {

using namespace flbc;

struct Case {
  const char* name;
  const char* cage;
  Index vertices;
};

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

DomainMesh<2> mesh_of(const Cage<2>& cage, Index vertices) {
  return triangulate(cage, {vertices});
}
DomainMesh<3> mesh_of(const Cage<3>& cage, Index vertices) {
  return tetrahedralize(cage, {vertices});
}

double peak_mebibytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024;
}

template <int Dim>
void run(const Case& test, const Cage<Dim>& cage, const SolverOptions& options) {
  const auto start = std::chrono::steady_clock::now();
  const auto mesh = mesh_of(cage, test.vertices);
  const double mesh_seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  const auto report = solve(cage, mesh, options).report;
  std::printf(
      "%-10s %4d %7d %8d %6d %8.2f %6.2f %6.2f %7.2f %7.2f %8.1f %8.0f %10.2e %9.1e %6.2f%s\n",
      test.name, report.control_points, report.vertices, report.cells, report.iterations,
      1000 * report.seconds.solve / report.iterations, mesh_seconds, report.seconds.setup,
      report.seconds.solve, report.seconds.recover, report.numbers_per_cell, peak_mebibytes(),
      report.quality.min_weight, report.quality.max_reproduction_error,
      report.quality.mean_influences,
      report.status == SolveStatus::kConverged ? "" : "  NOT CONVERGED");
  std::fflush(stdout);
}

SolverOptions parse(int argc, char** argv) {
  SolverOptions options;
  for (int k = 2; k + 1 < argc; k += 2) {
    const std::string name = argv[k];
    const std::string value = argv[k + 1];
    if (name == "--threads") {
      options.threads = std::stoi(value);
    } else if (name == "--tolerance") {
      options.tolerance = std::stod(value);
    } else if (name == "--method" && (value == "gradient" || value == "paper")) {
      options.method = value == "paper" ? Method::kPaper : Method::kGradient;
    } else {
      throw std::invalid_argument("unknown option " + name + " " + value);
    }
  }
  return options;
}

// \return true if the case ended well
bool run_isolated(const Case& test, const std::string& path, const SolverOptions& options) {
  const pid_t child = fork();
  if (child == 0) {
    try {
      const auto cage = io::to_cage(io::read_obj(path), path);
      std::visit([&](const auto& any) { run(test, any, options); }, cage);
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
    std::fprintf(stderr, "usage: %s MODELS_FOLDER [--threads T] [--method M] [--tolerance T]\n",
                 argv[0]);
    return 1;
  }
  try {
    const auto options = parse(argc, argv);
    std::printf("%-10s %4s %7s %8s %6s %8s %6s %6s %7s %7s %8s %8s %10s %9s %6s\n", "model", "n",
                "V", "cells", "its", "ms/it", "mesh s", "setup", "solve s", "recover", "num/cell",
                "MiB", "min w", "repro", "infl");
    std::fflush(stdout);
    bool ok = true;
    for (const auto& test : kCases) {
      const auto path = std::string(argv[1]) + "/" + test.cage;
      if (!std::ifstream(path)) {
        std::fprintf(stderr, "%s: skipped, %s is absent\n", test.name, path.c_str());
        continue;
      }
      ok = run_isolated(test, path, options) && ok;
    }
    return ok ? 0 : 1;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}

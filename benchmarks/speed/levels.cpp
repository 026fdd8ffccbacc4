// SPDX-License-Identifier: BSD-3-Clause
// value from a cold start and from coarser meshes, which are made and solved within the time.
#include <algorithm>

#include "flbc/solver.h"
#include "paper/experiments.h"
#include "paper/references.h"
#include "paper/result_table.h"
#include "paper/run_columns.h"

namespace flbc::bench {
namespace {

struct Size {
  const char* model;
  Index vertices;
  int repetitions;
};
constexpr Size kSizes[] = {{"woody", 10800, 5},  {"cactus", 10850, 5}, {"woody", 30000, 3},
                           {"woody", 100000, 2}, {"horse", 20000, 3},  {"horse", 40000, 2}};
constexpr double kTolerances[] = {1e-5, 1e-7};

// The least seconds of some runs; the solution is the same.
struct Timed {
  Solution solution;
  double seconds = 1e300;
};

template <int Dim>
Timed timed(const Setting<Dim>& setting, const SolverOptions& options,
            const CoarseMesher<Dim>& mesher, int repetitions) {
  Timed best;
  for (int k = 0; k < repetitions; ++k) {
    best.solution = solve(setting.problem.cage, setting.problem.mesh, options, mesher);
    best.seconds = std::min(best.seconds, seconds_of(best.solution.report));
  }
  return best;
}

template <int Dim>
Row compare(const Context& context, const Setting<Dim>& setting, double tolerance,
            int repetitions) {
  SolverOptions options;
  options.threads = context.threads;
  options.tolerance = tolerance;
  const auto warm = timed(setting, options, coarse_mesher<Dim>(), repetitions);
  options.coarse_to_fine = CoarseToFine::kOff;
  const auto cold = timed(setting, options, CoarseMesher<Dim>{}, repetitions);
  auto row = mesh_row(setting);
  row["tolerance"] = number(tolerance);
  row["cold_iterations"] = std::to_string(cold.solution.report.iterations);
  row["cold_seconds"] = number(cold.seconds);
  row["iterations"] = std::to_string(warm.solution.report.iterations);
  row["coarse_levels"] = std::to_string(warm.solution.report.coarse_levels.size());
  row["seconds"] = number(warm.seconds);
  row["times"] = number(cold.seconds / warm.seconds);
  if (setting.problem.mesh.num_vertices() < 15000) {
    const auto optimum = reference(context, setting);
    const auto error = [&](const Timed& run) {
      return number(squared_error(setting.problem, run.solution.weights, optimum.weights) /
                    tolerance);
    };
    row["cold_error"] = error(cold);
    row["error"] = error(warm);
  }
  return row;
}

}  // namespace

bool run_levels(const Context& context) {
  ResultTable table(context, "levels",
                    joined({mesh_columns(),
                            {"tolerance", "cold_iterations", "cold_seconds", "cold_error",
                             "coarse_levels", "iterations", "seconds", "error", "times"}}));
  for (const auto& size : kSizes) {
    const auto& chosen = model(size.model);
    table.add(in_setting(context, "levels", chosen, context.size(chosen.dim, size.vertices),
                         [&](const auto& setting) {
                           std::string lines;
                           for (const double tolerance : kTolerances) {
                             lines +=
                                 table.line(compare(context, setting, tolerance, size.repetitions));
                           }
                           return lines;
                         }));
  }
  return table.write(
      "value from a cold start with exact distances, and from coarser meshes with interpolated "
      "ones: set-up and solve; error: mean squared, relative to the tolerance; the least of some "
      "runs");
}

}  // namespace flbc::bench

// SPDX-License-Identifier: BSD-3-Clause
// Time and memory of the whole way, from 20,000 triangles or 25,000 tetrahedra to a hundred times
// as many.
#include <algorithm>
#include <cmath>

#include "flbc/solver.h"
#include "paper/experiments.h"
#include "paper/result_table.h"
#include "paper/run_columns.h"

namespace flbc::bench {
namespace {

std::vector<std::string> columns() {
  return joined({mesh_columns(),
                 {"coarse_levels", "iterations", "setup_seconds", "solve_seconds", "total_seconds",
                  "peak_mebibytes", "microseconds_per_cell", "bytes_per_cell"}});
}

std::vector<Index> resolutions(const Context& context, int dim) {
  if (context.quick) return {1000, 4000};
  if (dim == 2) return {10000, 30000, 100000, 300000, 1000000};
  return {5800, 20000, 60000, 180000, 440000};
}

template <int Dim>
Row measure(const Context& context, const Setting<Dim>& setting) {
  SolverOptions options;
  options.threads = context.threads;
  options.tolerance = 1e-5;
  const auto report = solve(setting.problem, options, coarse_mesher<Dim>()).report;
  const double total = setting.setup_seconds + report.seconds.solve + report.seconds.recover;
  auto row = mesh_row(setting);
  row["iterations"] = std::to_string(report.iterations);
  row["coarse_levels"] = std::to_string(report.coarse_levels.size());
  row["setup_seconds"] = number(setting.setup_seconds);
  row["solve_seconds"] = number(report.seconds.solve + report.seconds.recover);
  row["total_seconds"] = number(total);
  row["peak_mebibytes"] = number(peak_mebibytes());
  row["microseconds_per_cell"] = number(1e6 * total / report.cells);
  row["bytes_per_cell"] = number(peak_mebibytes() * 1024 * 1024 / report.cells);
  return row;
}

}  // namespace

bool run_growth(const Context& context) {
  ResultTable table(context, "growth", columns());
  for (const char* name : {"woody", "horse"}) {
    for (const Index vertices : resolutions(context, model(name).dim)) {
      table.add(in_setting(context, "growth", model(name), vertices, [&](const auto& setting) {
        return table.line(measure(context, setting));
      }));
    }
  }
  return table.write("value with tolerance 1e-5, the whole way but for meshing");
}

}  // namespace flbc::bench

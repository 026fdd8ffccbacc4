// SPDX-License-Identifier: BSD-3-Clause
// Figure 3: time and memory against the resolution of the mesh.
#include <algorithm>

#include "flbc/solver.h"
#include "paper/experiments.h"
#include "paper/methods.h"
#include "paper/result_table.h"
#include "paper/run_columns.h"

namespace flbc::bench {
namespace {

std::vector<std::string> columns() {
  return joined({mesh_columns(),
                 run_columns(),
                 {"coarse_levels", "problem_mebibytes", "solve_mebibytes", "peak_mebibytes", "relative_gap"}});
}

// The methods of the paper's kind, with a global system and without, and the default one.
struct Curve {
  NamedMethod method;
  LinearSolver linear_solver;
  Index largest_3d;  // vertices: growth is that of methods without a global system
};

std::vector<Curve> curves() {
  return {{{"paper", Method::kPaper, 0}, LinearSolver::kNone, 40000},
          {{"gradient", Method::kGradient, 0}, LinearSolver::kAuto, 40000},
          {{"gradient-local", Method::kGradient, 0}, LinearSolver::kNone, 200000},
          {{"value", Method::kValue, 0}, LinearSolver::kAuto, 40000}};
}

std::vector<Index> resolutions(const Context& context, int dim) {
  if (dim == 2) {
    return context.quick ? std::vector<Index>{1000, 2000, 4000}
                         : std::vector<Index>{2000, 5000, 10000, 20000, 50000};
  }
  return context.quick ? std::vector<Index>{2000, 3000, 4000}
                       : std::vector<Index>{2000, 5000, 10000, 20000, 40000, 100000, 200000};
}

template <int Dim>
Row measure(const Context& context, const Setting<Dim>& setting, const Curve& curve) {
  constexpr int kMostIterations = 5000;
  constexpr int kQuickIterations = 200;
  const auto& method = curve.method;
  auto options = method.options(setting.problem, context.threads);
  options.linear_solver = curve.linear_solver;
  options.max_iterations = context.quick ? kQuickIterations : kMostIterations;

  const double problem_memory = resident_mebibytes();
  const double setup_peak = peak_mebibytes();
  reset_peak();
  const auto report = solve(setting.problem, options, coarse_mesher<Dim>()).report;
  const double solve_peak = peak_mebibytes();

  auto row = mesh_row(setting);
  add_run(row, method.name, setting.setup_seconds, report);
  row["coarse_levels"] = std::to_string(report.coarse_levels.size());
  row["problem_mebibytes"] = number(problem_memory);
  row["solve_mebibytes"] = number(solve_peak - problem_memory);
  row["peak_mebibytes"] = number(std::max(setup_peak, solve_peak));
  if (method.method == Method::kValue) {
    options.certify = true;  // in a second run, so that its memory and time are not in the first
    const auto certified = solve(setting.problem, options, coarse_mesher<Dim>());
    row["relative_gap"] = number(certified.report.certificate.relative_gap);
  }
  return row;
}

}  // namespace

bool run_figure3(const Context& context) {
  ResultTable table(context, "figure3", columns());
  for (const char* name : {"woody", "horse"}) {
    for (const auto& curve : curves()) {
      for (const Index vertices : resolutions(context, model(name).dim)) {
        if (vertices > curve.largest_3d) continue;
        const auto what = std::string("figure3 ") + curve.method.name;
        table.add(in_setting(context, what, model(name), vertices, [&](const auto& setting) {
          return table.line(measure(context, setting, curve));
        }));
      }
    }
  }
  return table.write(
      "figure 3: from coarser meshes where flbc solve starts from these; problem = mesh, topology, boundary values and phi; solve = peak beyond that, the "
      "weights included; peak = of the whole process");
}

}  // namespace flbc::bench

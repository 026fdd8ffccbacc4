// SPDX-License-Identifier: BSD-3-Clause
// Figure 3 of the paper: time and memory against the resolution of the mesh.
#include "experiments.h"
#include "problems.h"

namespace flbc::bench {
namespace {

template <int Dim>
Row measure(const Setting<Dim>& setting, const NamedMethod& method) {
  auto options = method.options(setting.problem, setting.context.threads);
  options.max_iterations = setting.context.iterations(5000);

  const double problem_memory = resident_mebibytes();
  const double setup_peak = peak_mebibytes();
  reset_peak();
  const auto report = solve(setting.problem, options).report;
  const double solve_peak = peak_mebibytes();

  auto row = mesh_row(setting).add("method", method.name);
  add_run(row, setting.setup_seconds, report);
  row.add("problem_mebibytes", problem_memory)
      .add("solve_mebibytes", solve_peak - problem_memory)
      .add("peak_mebibytes", std::max(setup_peak, solve_peak));
  return row;
}

}  // namespace

bool run_figure3(const Context& context) {
  ResultTable table(context, "figure3",
                    "Figure 3: seconds and MiB with multilevel starts; problem: process, mesh, and "
                    "problem; solve: peak beyond that; peak: of the whole process");
  for (const auto* name : {"woody", "horse"}) {
    for (const auto& method : methods()) {
      if (method.method != Method::kPaper && method.method != Method::kWeights) continue;
      for (const Index vertices : {2000, 5000, 10000, 20000}) {
        add_rows(
            table, model(name), vertices,
            [&](const auto& setting) { return Rows{measure(setting, method)}; }, method.name);
      }
    }
  }
  return table.finish();
}

}  // namespace flbc::bench

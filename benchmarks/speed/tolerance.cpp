// SPDX-License-Identifier: BSD-3-Clause
// Whether value keeps its promise: the true mean squared error of its weights relative to the
// tolerance, from cold starts.
#include "flbc/solver.h"
#include "paper/experiments.h"
#include "paper/references.h"
#include "paper/result_table.h"
#include "paper/run_columns.h"

namespace flbc::bench {
namespace {

struct Case {
  Model model;
  Index vertices;
};

const std::vector<Case>& cases() {
  const Model arm{"arm", 3, "3d/arm_cage.obj", 0, 0, 0};
  const Model clothing{"clothing", 3, "3d/clothing_cage.obj", 0, 0, 0};
  static const std::vector<Case> kCases = {{model("woody"), 2000},
                                           {model("woody"), 7000},
                                           {model("cactus"), 2000},
                                           {model("cactus"), 7000},
                                           {model("logo"), 2000},
                                           {model("logo"), 7000},
                                           {model("horse"), 2000},
                                           {model("horse"), 6000},
                                           {model("armadillo"), 4100},
                                           {model("armadillo"), 6600},
                                           {model("shark"), 2000},
                                           {model("shark"), 6000},
                                           {model("shark"), 20000},
                                           {model("beast"), 2000},
                                           {model("beast"), 6000},
                                           {arm, 2500},
                                           {arm, 6500},
                                           {clothing, 3000},
                                           {clothing, 6500}};
  return kCases;
}

constexpr double kTolerances[] = {1e-4, 1e-5, 1e-6, 1e-7, 1e-8};

template <int Dim>
std::string measure(const Context& context, const ResultTable& table, const Setting<Dim>& setting) {
  const auto optimum = reference(context, setting);
  std::string lines;
  for (const double tolerance : kTolerances) {
    SolverOptions options;
    options.threads = context.threads;
    options.tolerance = tolerance;
    const auto solution = solve(setting.problem, options);
    auto row = mesh_row(setting);
    row["tolerance"] = number(tolerance);
    row["converged"] = solution.report.status == SolveStatus::kConverged ? "1" : "0";
    row["iterations"] = std::to_string(solution.report.iterations);
    row["error"] =
        number(squared_error(setting.problem, solution.weights, optimum.weights) / tolerance);
    lines += table.line(row);
  }
  return lines;
}

}  // namespace

bool run_tolerance(const Context& context) {
  ResultTable table(context, "tolerance",
                    joined({mesh_columns(), {"tolerance", "converged", "iterations", "error"}}));
  for (const auto& one : cases()) {
    const std::string name = one.model.name;
    if (context.quick && (one.vertices != 2000 || (name != "woody" && name != "horse"))) continue;
    table.add(in_setting(context, "tolerance", one.model, context.size(one.model.dim, one.vertices),
                         [&](const auto& setting) { return measure(context, table, setting); }));
  }
  return table.write(
      "value from cold starts; error: mean squared, to the optimum, relative to the tolerance; "
      "nothing of this depends on the machine");
}

}  // namespace flbc::bench

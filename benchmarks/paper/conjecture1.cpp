// SPDX-License-Identifier: BSD-3-Clause
// Conjecture 1 measured: local extrema inside the domain, with and without non-negativity, at the
// optimum and where a run ends by default.
#include <algorithm>

#include "flbc/check.h"
#include "flbc/solver.h"
#include "paper/experiments.h"
#include "paper/references.h"
#include "paper/result_table.h"
#include "paper/run_columns.h"

namespace flbc::bench {
namespace {

std::vector<std::string> columns() {
  return joined({mesh_columns(),
                 {"non_negative", "run", "tolerance", "iterations", "converged", "interior_vertices",
                  "functions_with_minima", "minima", "deepest_minimum", "functions_with_maxima",
                  "maxima", "highest_maximum", "min_weight", "relative_gap"}});
}

Index total(const std::vector<Index>& counts) {
  Index sum = 0;
  for (const Index count : counts) sum += count;
  return sum;
}

std::string functions_with(const std::vector<Index>& counts) {
  return std::to_string(std::count_if(counts.begin(), counts.end(), [](Index c) { return c > 0; }));
}

template <int Dim>
Row measure(const Setting<Dim>& setting, const SolverOptions& options) {
  const auto& problem = setting.problem;
  const auto solution = solve(problem, options);
  const auto check = *check_weights(problem.cage, problem.mesh, solution.weights).mesh;
  const auto& report = solution.report;
  auto row = mesh_row(setting);
  row["non_negative"] = options.non_negative == NonNegative::kOff ? "0" : "1";
  row["run"] = options.precision == Precision::kDouble ? "optimum" : "default";
  row["tolerance"] = number(*resolve(options).tolerance);
  row["iterations"] = std::to_string(report.iterations);
  row["converged"] = report.status == SolveStatus::kConverged ? "1" : "0";
  row["interior_vertices"] = std::to_string(check.interior_vertices);
  row["functions_with_minima"] = functions_with(check.local_minima);
  row["minima"] = std::to_string(total(check.local_minima));
  row["deepest_minimum"] = number(check.deepest_minimum.value);
  row["functions_with_maxima"] = functions_with(check.local_maxima);
  row["maxima"] = std::to_string(total(check.local_maxima));
  row["highest_maximum"] = number(check.highest_maximum.value);
  row["min_weight"] = number(report.quality.min_weight);
  row["relative_gap"] = number(report.certificate.relative_gap);
  return row;
}

}  // namespace

bool run_conjecture1(const Context& context) {
  ResultTable table(context, "conjecture1", columns());
  for (const auto& model : models()) {
    const Index vertices = context.quick ? model.small_size * 2 / 3 : model.small_size;
    for (const auto non_negative : {NonNegative::kOff, NonNegative::kConstraint}) {
      auto optimum = optimum_options(context, non_negative);
      optimum.tolerance = context.quick ? optimum.tolerance : 1e-12;
      optimum.max_iterations = context.quick ? optimum.max_iterations : 20000;
      SolverOptions by_default;
      by_default.non_negative = non_negative;
      by_default.threads = context.threads;
      by_default.certify = true;
      for (const auto& options : {optimum, by_default}) {
        table.add(in_setting(context, "conjecture1", model, vertices, [&](const auto& setting) {
          return table.line(measure(setting, options));
        }));
      }
    }
  }
  return table.write(
      "conjecture 1: interior vertices at which a coordinate function is below, or above, all its "
      "neighbours by more than 1e-6; the deepest and the highest of these, as distances from the "
      "neighbours; method value, at the optimum (double precision, 1e-12) and by default");
}

}  // namespace flbc::bench

// SPDX-License-Identifier: BSD-3-Clause
// Table 1: what non-negativity costs and changes. Both optima are computed by the same method to
// the same accuracy; they are not read from the cache, because their times are the result.
#include "flbc/solver.h"
#include "paper/experiments.h"
#include "paper/references.h"
#include "paper/result_table.h"
#include "paper/run_columns.h"

namespace flbc::bench {
namespace {

std::vector<std::string> columns() {
  return joined({mesh_columns(),
                 {"seconds_with", "seconds_without", "iterations_with", "iterations_without",
                  "squared_distance", "largest_difference", "min_weight_without",
                  "relative_gap_with", "relative_gap_without", "paper_squared_distance"}});
}

double seconds_without_setup(const SolveReport& report) {
  return report.seconds.solve + report.seconds.recover;
}

template <int Dim>
Row compare(const Context& context, const Setting<Dim>& setting) {
  const auto& problem = setting.problem;
  const auto with = solve(problem, optimum_options(context, NonNegative::kConstraint));
  const auto without = solve(problem, optimum_options(context, NonNegative::kOff));
  auto row = mesh_row(setting);
  row["seconds_with"] = number(seconds_without_setup(with.report));
  row["seconds_without"] = number(seconds_without_setup(without.report));
  row["iterations_with"] = std::to_string(with.report.iterations);
  row["iterations_without"] = std::to_string(without.report.iterations);
  row["squared_distance"] = number(squared_error(problem, with.weights, without.weights));
  row["largest_difference"] =
      number((with.weights - without.weights).template lpNorm<Eigen::Infinity>());
  row["min_weight_without"] = number(without.report.quality.min_weight);
  row["relative_gap_with"] = number(with.report.certificate.relative_gap);
  row["relative_gap_without"] = number(without.report.certificate.relative_gap);
  if (setting.model.paper.squared_distance > 0) {
    row["paper_squared_distance"] = number(setting.model.paper.squared_distance);
  }
  return row;
}

}  // namespace

bool run_table1(const Context& context) {
  ResultTable table(context, "table1", columns());
  for (const auto& model : models()) {
    const Index vertices = context.size(model.dim, model.paper_size);
    table.add(in_setting(context, "table1", model, vertices, [&](const auto& setting) {
      return table.line(compare(context, setting));
    }));
  }
  return table.write(
      "table 1: optima with and without non-negativity, method value in double precision; both "
      "gaps are of weights made non-negative, in the problem with non-negativity");
}

}  // namespace flbc::bench

// SPDX-License-Identifier: BSD-3-Clause
// Table 2: all methods at the paper's sizes, each by its own stopping rule.
#include "flbc/solver.h"
#include "paper/experiments.h"
#include "paper/methods_table.h"

namespace flbc::bench {
namespace {

std::vector<std::string> columns() {
  return joined(
      {mesh_columns(),
       run_columns(),
       {"penalty", "error", "min_weight", "mean_influences", "relative_gap", "reference_gap",
        "paper_lbc_error", "paper_lbc_seconds", "paper_flbc_error", "paper_flbc_seconds"}});
}

// The paper's own results, for comparison beside each row.
void add_paper(Row& row, const PaperNumbers& paper) {
  if (paper.lbc_error == 0) return;
  row["paper_lbc_error"] = number(paper.lbc_error);
  row["paper_lbc_seconds"] = number(paper.lbc_seconds);
  row["paper_flbc_error"] = number(paper.flbc_error);
  row["paper_flbc_seconds"] = number(paper.flbc_seconds);
}

template <int Dim>
Row measure(const Context& context, const Setting<Dim>& setting, const NamedMethod& method) {
  constexpr int kMostIterations = 5000;
  constexpr int kQuickIterations = 300;
  auto options = method.options(setting.problem, context.threads);
  options.max_iterations = context.quick ? kQuickIterations : kMostIterations;
  options.certify = true;
  const auto [weights, sparse, report] = solve(setting.problem, options);
  const auto optimum = reference(context, setting);

  auto row = mesh_row(setting);
  add_run(row, method.name, setting.setup_seconds, report);
  row["penalty"] = number(report.published_penalty);
  row["error"] = number(squared_error(setting.problem, weights, optimum.weights));
  row["min_weight"] = number(report.quality.min_weight);
  row["mean_influences"] = number(report.quality.mean_influences);
  row["relative_gap"] = number(report.certificate.relative_gap);
  row["reference_gap"] = number(optimum.relative_gap);
  add_paper(row, setting.model.paper);
  return row;
}

}  // namespace

bool run_table2(const Context& context) {
  ResultTable table(context, "table2", columns());
  add_methods(
      context, "table2", table, [](const NamedMethod&) { return true; },
      [&](const auto& setting, const NamedMethod& method) {
        return measure(context, setting, method);
      });
  return table.write("table 2: error = mean squared difference to the certified optimum");
}

}  // namespace flbc::bench

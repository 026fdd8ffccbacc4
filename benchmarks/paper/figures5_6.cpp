// SPDX-License-Identifier: BSD-3-Clause
// Figures 5 and 6: error against time. A point of a curve is a run of its own with so many
// iterations, so that time and weights are those a user would get by stopping there.
#include <algorithm>

#include "flbc/solver.h"
#include "paper/experiments.h"
#include "paper/methods.h"
#include "paper/references.h"
#include "paper/result_table.h"
#include "paper/run_columns.h"

namespace flbc::bench {
namespace {

struct Curves {
  const char* model;
  Index vertices;
  int first;              // iterations of the first point
  int factor;             // from point to point
  int last_of_splitting;  // iterations of the last point: methods that solve a global system
  int last_of_gradients;  // methods in the gradient domain
};

bool in_gradient_domain(Method method) {
  return method == Method::kGradient || method == Method::kPaper;
}

template <int Dim>
std::string curve(const Context& context, const ResultTable& table, const Curves& curves,
                  const Setting<Dim>& setting, const NamedMethod& method) {
  constexpr int kQuickIterations = 200;
  const auto optimum = reference(context, setting);
  int last =
      in_gradient_domain(method.method) ? curves.last_of_gradients : curves.last_of_splitting;
  if (context.quick) last = std::min(last, kQuickIterations);
  auto options = method.options(setting.problem, context.threads);
  options.tolerance = 1e-30;  // never met: the number of iterations decides
  std::string lines;
  for (int iterations = curves.first; iterations <= last; iterations *= curves.factor) {
    options.max_iterations = iterations;
    const auto [weights, sparse, report] = solve(setting.problem, options);
    auto row = mesh_row(setting);
    add_run(row, method.name, setting.setup_seconds, report);
    row["error"] = number(squared_error(setting.problem, weights, optimum.weights));
    row["min_weight"] = number(report.quality.min_weight);
    row["reference_gap"] = number(optimum.relative_gap);
    lines += table.line(row);
  }
  return lines;
}

bool run(const Context& context, const char* name, const std::vector<Curves>& all,
         const std::string& about) {
  ResultTable table(
      context, name,
      joined({mesh_columns(), run_columns(), {"error", "min_weight", "reference_gap"}}));
  for (const auto& curves : all) {
    const auto& shape = model(curves.model);
    const Index vertices = context.size(shape.dim, curves.vertices);
    for (const auto& method : methods()) {
      const auto what = std::string(name) + " " + method.name;
      table.add(in_setting(context, what, shape, vertices, [&](const auto& setting) {
        return curve(context, table, curves, setting, method);
      }));
    }
  }
  return table.write(about);
}

}  // namespace

bool run_figure5(const Context& context) {
  return run(context, "figure5",
             {{"woody", model("woody").paper_size, 5, 2, 2560, 2560},
              {"horse", model("horse").paper_size, 5, 2, 2560, 1280}},
             "figure 5: error = mean squared difference to the certified optimum");
}

bool run_figure6(const Context& context) {
  return run(context, "figure6",
             {{"woody", 50000, 10, 4, 640, 640}, {"horse", 20000, 10, 4, 640, 640}},
             "figure 6: as figure 5, large meshes");
}

}  // namespace flbc::bench

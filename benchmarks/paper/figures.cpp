// SPDX-License-Identifier: BSD-3-Clause
// Figures 2 and 4 of the paper, which are pictures of coordinate functions, and figure 3: time and
// memory against the resolution of the mesh.
#include <filesystem>

#include "experiments.h"
#include "flbc/io/weights_io.h"
#include "problems.h"

namespace flbc::bench {
namespace {

struct Picture {
  const char* model;
  Index vertices;
  int slices;  // 0 in 2D
};

// The weights, and a row of the options of `flbc draw`.
template <int Dim>
Row compute(const std::string& figure, const Setting<Dim>& setting, int slices) {
  SolverOptions options;
  options.tolerance = 1e-8;  // below what a picture shows
  options.threads = setting.context.threads;
  const auto stem = figure + "-" + setting.name;
  std::filesystem::create_directories(setting.context.out + "/weights");
  io::write_weights(setting.context.out + "/weights/" + stem + ".npy",
                    solve(setting.problem, options).weights);
  return mesh_row(setting)
      .add("picture", "pictures/" + stem + ".png")
      .add("domain", domain_path(setting.model, setting.name))
      .add("weights", "weights/" + stem + ".npy")
      .add("cage", setting.model.cage)
      .add("control_point", setting.model.control_point)
      .add("slices", slices);
}

bool run_pictures(const Context& context, const char* figure, const std::vector<Picture>& pictures,
                  const std::string& about) {
  ResultTable table(context, figure);
  for (const auto& picture : pictures) {
    add_rows(table, model(picture.model), picture.vertices,
             [&](const auto& setting) { return Rows{compute(figure, setting, picture.slices)}; });
  }
  return table.write(about +
                     "; domain, weights and picture are in this folder, cage in the models'");
}

// The methods of the paper's kind, with a global system and without, and the default one.
struct Curve {
  NamedMethod method;
  LinearSolver linear_solver;
  Index largest;  // vertices: growth is that of methods without a global system
};

template <int Dim>
Row measure(const Setting<Dim>& setting, const Curve& curve) {
  const auto& method = curve.method;
  auto options = method.options(setting.problem, setting.context.threads);
  options.linear_solver = curve.linear_solver;
  options.max_iterations = setting.context.iterations(5000);

  const double problem_memory = resident_mebibytes();
  const double setup_peak = peak_mebibytes();
  reset_peak();
  const auto report = solve(setting.problem, options, coarse_mesher<Dim>()).report;
  const double solve_peak = peak_mebibytes();

  auto row = mesh_row(setting).add("method", method.name);
  add_run(row, setting.setup_seconds, report);
  row.add("problem_mebibytes", problem_memory)
      .add("solve_mebibytes", solve_peak - problem_memory)
      .add("peak_mebibytes", std::max(setup_peak, solve_peak));
  if (method.method == Method::kValue) {
    options.certify = true;  // in a second run, so that its memory and time are not in the first
    const auto certified = solve(setting.problem, options, coarse_mesher<Dim>());
    row.add("relative_gap", certified.report.certificate.relative_gap);
  }
  return row;
}

}  // namespace

bool run_figure2(const Context& context) {
  return run_pictures(context, "figure2",
                      {{"woody", 2000, 0},
                       {"woody", 10000, 0},
                       {"woody", 50000, 0},
                       {"horse", 2000, 1},
                       {"horse", 10000, 1},
                       {"horse", 40000, 1}},
                      "figure 2: one function at growing resolution");
}

bool run_figure3(const Context& context) {
  const std::vector<Curve> curves = {
      {{"paper", Method::kPaper, 0}, LinearSolver::kNone, 40000},
      {{"gradient", Method::kGradient, 0}, LinearSolver::kAuto, 40000},
      {{"gradient-local", Method::kGradient, 0}, LinearSolver::kNone, 200000},
      {{"value", Method::kValue, 0}, LinearSolver::kAuto, 40000}};
  const std::vector<Index> woody = {2000, 5000, 10000, 20000, 50000};
  const std::vector<Index> horse = {2000, 5000, 10000, 20000, 40000, 100000, 200000};
  ResultTable table(context, "figure3");
  for (const auto& [name, sizes] : {std::pair{"woody", woody}, {"horse", horse}}) {
    for (const auto& curve : curves) {
      for (const Index vertices : sizes) {
        if (model(name).dim == 3 && vertices > curve.largest) continue;
        add_rows(
            table, model(name), vertices,
            [&](const auto& setting) { return Rows{measure(setting, curve)}; }, curve.method.name);
      }
    }
  }
  return table.write(
      "figure 3: from coarser meshes where flbc solve starts from these; problem = mesh, topology, "
      "boundary values and phi; solve = peak beyond that, the weights included; peak = of the "
      "whole "
      "process");
}

bool run_figure4(const Context& context) {
  return run_pictures(context, "figure4", {{"horse", 5850, 3}, {"armadillo", 6640, 3}},
                      "figure 4: one function on three slices");
}

}  // namespace flbc::bench

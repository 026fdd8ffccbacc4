// SPDX-License-Identifier: BSD-3-Clause
// Cages of many control points: iterations on all pairs of control points and vertices, and on
// the active set.
#include <cstdio>
#include <filesystem>
#include <stdexcept>

#include "experiments.h"
#include "flbc/cage_from_model.h"
#include "flbc/io/weights_io.h"
#include "problems.h"

namespace flbc::bench {
namespace {

struct Case {
  Index control_points;  // of a cage made from the armadillo; 0: the papers' cage
  Index vertices;
  double tolerance;
  int repetitions;
  bool on_all_pairs = true;  // else on the active set only
};
constexpr Case kCases[] = {
    {0, 6640, 1e-5, 3},    {0, 6640, 1e-7, 3},     {250, 10000, 1e-7, 2},
    {50, 20000, 1e-6, 2},  {110, 20000, 1e-6, 2},  {250, 20000, 1e-6, 1},
    {500, 20000, 1e-6, 1}, {1000, 20000, 1e-6, 1}, {1000, 100000, 1e-5, 1, false}};

Cage<3> cage_of(const Context& context, const Case& chosen) {
  if (chosen.control_points == 0) return read_cage<3>(cage_path(context, model("armadillo")));
  const auto armadillo = read_cage<3>(context.models + "/3d/armadillo.obj");
  CagingOptions options;
  options.control_points = chosen.control_points;
  return cage_from_model<3>(armadillo.points, armadillo.facets, options).cage;
}

double mean_squared_difference(const SparseWeights& a, const SparseWeights& b) {
  double sum = 0;
  for (Index p = 0; p < a.num_points(); ++p) sum += (a.at(p) - b.at(p)).squaredNorm();
  return sum / a.num_points() / a.num_control_points();
}

//! \param weights  file that a run on all pairs writes and the other one compares with
Row measure(const Context& context, const Case& chosen, ActiveSet active,
            const std::string& weights) {
  omp_set_num_threads(context.threads);
  const auto cage = cage_of(context, chosen);
  const auto mesh = mesh_of(cage, context.size(chosen.vertices));
  SolverOptions options;
  options.threads = context.threads;
  options.tolerance = chosen.tolerance;
  options.active_set = active;
  const auto solution = fastest(chosen.repetitions, [&] { return solve(cage, mesh, options); });
  const auto& report = solution.report;
  const bool all = active == ActiveSet::kOff;
  const std::string prefix = all ? "all_" : "";
  auto row = Row()
                 .add(prefix + "iterations", report.iterations)
                 .add(prefix + "seconds", seconds_of(report))
                 .add(prefix + "mebibytes", peak_mebibytes());
  if (all) {
    io::write_weights(weights, solution.weights);
    return row;
  }
  row.add("density", report.active_set.density)
      .add("cage", chosen.control_points == 0 ? "armadillo" : "made")
      .add("control_points", cage.size())
      .add("vertices", mesh.num_vertices())
      .add("tolerance", chosen.tolerance);
  if (chosen.on_all_pairs) {
    row.add("difference", mean_squared_difference(solution.weights, io::read_weights(weights)));
  }
  return row;
}

// One row of both runs, each in a process of its own.
Rows compare(const Context& context, const Case& chosen) {
  const auto weights = context.out + "/many_control_points.mtx";
  Row joined;
  for (const auto active : {ActiveSet::kOff, ActiveSet::kOn}) {
    if (active == ActiveSet::kOff && !chosen.on_all_pairs) continue;
    const auto rows = in_child(active == ActiveSet::kOff ? "  all pairs" : "  active set",
                               [&] { return Rows{measure(context, chosen, active, weights)}; });
    if (!rows) throw std::runtime_error("a run failed");
    for (const auto& [column, cell] : rows->front().cells()) joined.add(column, cell);
  }
  std::filesystem::remove(weights);
  return Rows{joined};
}

}  // namespace

bool run_many(const Context& context) {
  if (!context.wants("armadillo")) return true;
  ResultTable table(context, "many",
                    "Default method on all pairs and on the active set: seconds of setup and solve "
                    "with coarse meshes, the least of up to 3 runs");
  for (const auto& chosen : kCases) {
    if (context.quick && chosen.control_points > 250) continue;
    char which[64];
    std::snprintf(which, sizeof which, "n=%d V=%d %.0e", static_cast<int>(chosen.control_points),
                  static_cast<int>(chosen.vertices), chosen.tolerance);
    table.add(which, [&] { return compare(context, chosen); });
  }
  return table.finish();
}

}  // namespace flbc::bench

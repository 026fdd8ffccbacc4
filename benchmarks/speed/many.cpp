// SPDX-License-Identifier: BSD-3-Clause
// Cages of many control points: iterations on all pairs of control points and vertices, and on
// supports.
#include <omp.h>

#include <algorithm>
#include <filesystem>
#include <sstream>

#include "flbc/cage_from_model.h"
#include "flbc/io/cage_io.h"
#include "flbc/io/model_file.h"
#include "flbc/io/weights_io.h"
#include "flbc/solver.h"
#include "paper/experiments.h"
#include "paper/machine.h"
#include "paper/result_table.h"
#include "paper/run_columns.h"
#include "paper/setting.h"

namespace flbc::bench {
namespace {

struct Case {
  Index control_points;  // of a cage made from the armadillo; 0: the papers' cage
  Index vertices;
  double tolerance;
  int repetitions;
  bool on_all_pairs = true;  // else on supports only
};
constexpr Case kCases[] = {{0, 6640, 1e-5, 3},     {0, 6640, 1e-7, 3},
                           {250, 10000, 1e-5, 2},  {250, 10000, 1e-7, 2},
                           {50, 20000, 1e-6, 2},   {110, 20000, 1e-6, 2},
                           {250, 20000, 1e-6, 1},  {500, 20000, 1e-6, 1},
                           {1000, 20000, 1e-6, 1}, {1000, 100000, 1e-5, 1, false}};

// The report of a child process on its run.
struct Run {
  Index control_points = 0;
  Index vertices = 0;
  int iterations = 0;
  double seconds = 0;  // set-up, coarse meshes and solve
  double mebibytes = 0;
  double density = 1;     // of the pairs
  double difference = 0;  // mean squared, to the weights on all pairs
};

std::string text_of(const Run& run) {
  std::ostringstream text;
  text.precision(17);
  text << run.control_points << ' ' << run.vertices << ' ' << run.iterations << ' ' << run.seconds
       << ' ' << run.mebibytes << ' ' << run.density << ' ' << run.difference;
  return text.str();
}

Run run_of(const std::string& text) {
  std::istringstream in(text);
  Run run;
  in >> run.control_points >> run.vertices >> run.iterations >> run.seconds >> run.mebibytes >>
      run.density >> run.difference;
  return run;
}

Cage<3> surface_in(const std::string& file) {
  return std::get<Cage<3>>(io::to_cage(io::read_polygons(file), file));
}

Cage<3> cage_of(const Context& context, const Case& chosen) {
  if (chosen.control_points == 0) return surface_in(cage_path(context, model("armadillo")));
  const auto armadillo = surface_in(context.models + "/3d/armadillo.obj");
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
std::string measure(const Context& context, const Case& chosen, ActiveSet active,
                    const std::string& weights) {
  omp_set_num_threads(context.threads);
  const auto cage = cage_of(context, chosen);
  const auto mesh = mesh_of(cage, context.size(3, chosen.vertices));
  SolverOptions options;
  options.threads = context.threads;
  options.tolerance = chosen.tolerance;
  options.active_set = active;
  Run run;
  run.seconds = 1e300;
  options.sparse = true;
  Solution solution;
  for (int k = 0; k < chosen.repetitions; ++k) {
    solution = solve(cage, mesh, options, coarse_mesher<3>());
    run.seconds = std::min(run.seconds, seconds_of(solution.report));
  }
  run.mebibytes = peak_mebibytes();
  run.control_points = cage.size();
  run.vertices = mesh.num_vertices();
  run.iterations = solution.report.iterations;
  run.density = solution.report.active_set.density;
  if (active == ActiveSet::kOff) {
    io::write_weights(weights, solution.sparse_weights);
  } else if (chosen.on_all_pairs) {
    run.difference =
        mean_squared_difference(solution.sparse_weights, io::read_sparse_weights(weights));
  }
  return text_of(run);
}

std::optional<Row> compare(const Context& context, const Case& chosen) {
  const auto weights = context.out + "/many_control_points.mtx";
  const auto what = "many: " + std::to_string(chosen.control_points) + " control points, " +
                    std::to_string(chosen.vertices) + " vertices, " + number(chosen.tolerance);
  std::printf("%s\n", what.c_str());
  const auto by = [&](ActiveSet active) {
    return in_child(what, [&] { return measure(context, chosen, active, weights); });
  };
  const auto told_of_all = chosen.on_all_pairs ? by(ActiveSet::kOff) : std::nullopt;
  const bool failed = chosen.on_all_pairs && !told_of_all;
  const auto told_of_supports = failed ? std::nullopt : by(ActiveSet::kOn);
  std::filesystem::remove(weights);
  if (!told_of_supports) return std::nullopt;
  const auto supports = run_of(*told_of_supports);
  Row row{{"cage", chosen.control_points == 0 ? "armadillo" : "made"},
          {"control_points", std::to_string(supports.control_points)},
          {"vertices", std::to_string(supports.vertices)},
          {"tolerance", number(chosen.tolerance)},
          {"iterations", std::to_string(supports.iterations)},
          {"seconds", number(supports.seconds)},
          {"mebibytes", number(supports.mebibytes)},
          {"density", number(supports.density)}};
  if (!told_of_all) return row;
  const auto all = run_of(*told_of_all);
  row["all_iterations"] = std::to_string(all.iterations);
  row["all_seconds"] = number(all.seconds);
  row["all_mebibytes"] = number(all.mebibytes);
  row["times"] = number(all.seconds / supports.seconds);
  row["difference"] = number(supports.difference);
  return row;
}

}  // namespace

bool run_many(const Context& context) {
  ResultTable table(
      context, "many",
      {"cage", "control_points", "vertices", "tolerance", "all_iterations", "all_seconds",
       "all_mebibytes", "iterations", "seconds", "mebibytes", "density", "times", "difference"});
  if (!context.wants("armadillo")) return true;
  for (const auto& chosen : kCases) {
    if (context.quick && chosen.control_points > 250) continue;
    const auto row = compare(context, chosen);
    table.add(row ? std::optional(table.line(*row)) : std::nullopt);
  }
  return table.write(
      "value on all pairs and on the active set; setup, coarse meshes and solve, the least of up "
      "to 3 runs");
}

}  // namespace flbc::bench

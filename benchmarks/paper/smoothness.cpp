// SPDX-License-Identifier: BSD-3-Clause
// What SolverOptions::smoothness gives and costs: jumps of gradients, creases of a posed model,
// influences, iterations, seconds, and the true error.
#include <random>

#include "experiments.h"
#include "flbc/bounding_box.h"
#include "flbc/cell_locator.h"
#include "flbc/check.h"
#include "flbc/coordinates.h"
#include "flbc/deform.h"
#include "flbc/interpolate.h"
#include "problem/unit_scale.h"
#include "problems.h"

namespace flbc::bench {
namespace {

// Control points displaced at random by 5% of the size of the cage.
PointList<3> random_pose(const Cage<3>& cage) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> coordinate(-0.05, 0.05);
  const double size = bounding_box_diagonal(cage.points);
  PointList<3> pose = cage.points;
  for (double& number : pose.reshaped()) number += size * coordinate(random);
  return pose;
}

// Adds the creases of the model that belongs to the cage, posed.
void add_creases(Row& row, const Setting<3>& setting, const SparseWeights& weights) {
  const auto& problem = setting.problem;
  auto file = cage_path(setting.context, setting.model);
  const UnitScale<3> scale(read_cage<3>(file));
  const auto model = read_cage<3>(file.replace(file.rfind("_cage"), 5, ""));
  const auto points = scale(model.points);
  const auto of_points = interpolate(problem.mesh, weights, locate_points(problem.mesh, points));
  const auto creases =
      check_creases(points, deform<3>(of_points, random_pose(problem.cage)), model.facets);
  row.add("crease_mean", creases.mean)
      .add("crease_high", creases.high)
      .add("crease_largest", creases.largest);
}
void add_creases(Row&, const Setting<2>&, const SparseWeights&) {
}

template <int Dim>
void add_quality(Row& row, const Setting<Dim>& setting, const Solution& solution) {
  row.add("mean_influences", solution.report.quality.mean_influences)
      .add("gradient_jump", gradient_jump(setting.problem, solution.weights));
  add_creases(row, setting, solution.weights);
}

template <int Dim>
Rows measure(Setting<Dim> setting) {
  auto& problem = setting.problem;
  SolverOptions usual;
  usual.threads = setting.context.threads;
  Rows rows;
  for (const double smoothness : {0.0, 1e-3, 3e-3, 1e-2}) {
    problem.smoothness = smoothness;
    usual.smoothness = smoothness;
    auto options = usual;
    options.precision = Precision::kDouble;
    options.tolerance = 1e-11;
    options.max_iterations = 2000;  // enough for a unique optimum; smoothness 0 may have none
    const auto optimum = solve(problem, options);
    options = usual;
    options.tolerance = 1e-7;
    const auto cold = solve(problem, options);
    const double error = squared_error(problem, cold.weights, optimum.weights);
    const auto report = solve(problem.cage, problem.mesh, usual).report;
    rows.push_back(mesh_row(setting)
                       .add("smoothness", smoothness)
                       .add("converged", cold.report.status == SolveStatus::kConverged)
                       .add("iterations", cold.report.iterations)
                       .add("error", error / *options.tolerance)
                       .add("default_iterations", report.iterations)
                       .add("default_seconds", seconds_of(report)));
    add_quality(rows.back(), setting, optimum);
  }
  rows.push_back(mesh_row(setting).add("smoothness", "harmonic"));
  add_quality(rows.back(), setting,
              compute_coordinates(problem.cage, problem.mesh, Coordinates::kHarmonic,
                                  {NonNegative::kAuto, setting.context.threads}));
  return rows;
}

}  // namespace

bool run_smoothness(const Context& context) {
  ResultTable table(context, "smoothness",
                    "Default method: iterations to 1e-7 from a cold start and the true error "
                    "relative to 1e-7; default: from cage and mesh to weights; jumps of gradients "
                    "and creases (degrees) of the optimum, with control points moved at random by "
                    "5% of the cage size");
  for (const auto* name : {"woody", "cactus", "horse", "armadillo", "shark"}) {
    add_rows(table, model(name), model(name).paper_size,
             [](const auto& setting) { return measure(setting); });
  }
  return table.finish();
}

}  // namespace flbc::bench

// SPDX-License-Identifier: BSD-3-Clause
// What SolverOptions::smoothness gives and costs: jumps of gradients, creases of a posed model,
// influences, iterations, seconds, and the true error.
#include <cmath>
#include <random>

#include "flbc/bounding_box.h"
#include "flbc/cell_locator.h"
#include "flbc/check.h"
#include "flbc/deform.h"
#include "flbc/interpolate.h"
#include "flbc/io/cage_io.h"
#include "flbc/io/model_file.h"
#include "flbc/solver.h"
#include "paper/experiments.h"
#include "paper/result_table.h"
#include "paper/run_columns.h"
#include "problem/unit_scale.h"

namespace flbc::bench {
namespace {

constexpr double kSmoothness[] = {0, 1e-3, 3e-3, 1e-2, 3e-2};

// Control points displaced at random by 5 % of the size of the cage.
PointList<3> random_pose(const Cage<3>& cage) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> coordinate(-0.05, 0.05);
  const double size = bounding_box_diagonal(cage.points);
  PointList<3> pose = cage.points;
  for (double& number : pose.reshaped()) number += size * coordinate(random);
  return pose;
}

// The creases of the model that belongs to a cage.
class PosedModel {
 public:
  PosedModel(const Context&, const Setting<2>&) {}
  PosedModel(const Context& context, const Setting<3>& setting) {
    auto file = cage_path(context, setting.model);
    file.replace(file.rfind("_cage"), 5, "");
    const auto soup = io::read_polygons(file);
    const auto cage =
        std::get<Cage<3>>(io::to_cage(io::read_polygons(cage_path(context, setting.model)), file));
    triangles_ = std::get<Cage<3>>(io::to_cage(soup, file)).facets;
    pose_ = random_pose(setting.problem.cage);
    points_ = UnitScale<3>(cage)(io::to_points<3>(soup, file));
    places_ = locate_points(setting.problem.mesh, points_);
  }

  void add(Row& row, const Setting<3>& setting, const WeightMatrix& weights) const {
    const auto of_points = interpolate(setting.problem.mesh, weights, places_);
    const auto creases = check_creases(points_, deform<3>(of_points, pose_), triangles_);
    row["crease_mean"] = number(creases.mean);
    row["crease_high"] = number(creases.high);
    row["crease_largest"] = number(creases.largest);
  }
  void add(Row&, const Setting<2>&, const WeightMatrix&) const {}

 private:
  PointList<3> points_, pose_;
  FacetList<3> triangles_;
  std::vector<Location<3>> places_;
};

template <int Dim>
SolverOptions options_for(const Context& context, double smoothness) {
  SolverOptions options;
  options.threads = context.threads;
  options.smoothness = smoothness;
  return options;
}

template <int Dim>
void add_quality(Row& row, const Setting<Dim>& setting, const PosedModel& posed,
                 const Solution& solution) {
  row["mean_influences"] = number(solution.report.quality.mean_influences);
  row["gradient_jump"] = number(gradient_jump(setting.problem, solution.weights));
  posed.add(row, setting, solution.weights);
}

template <int Dim>
std::string measure(const Context& context, const ResultTable& table, Setting<Dim> setting) {
  const PosedModel posed(context, setting);
  auto& problem = setting.problem;
  std::string lines;
  for (const double smoothness : kSmoothness) {
    auto row = mesh_row(setting);
    row["smoothness"] = number(smoothness);
    problem.smoothness = smoothness;
    auto options = options_for<Dim>(context, smoothness);
    options.precision = Precision::kDouble;
    options.tolerance = 1e-11;
    options.max_iterations = 4000;  // enough for a unique optimum; smoothness 0 may have none
    const auto optimum = solve(problem, options);
    add_quality(row, setting, posed, optimum);
    options = options_for<Dim>(context, smoothness);
    options.tolerance = 1e-7;
    const auto cold = solve(problem, options);
    row["converged"] = cold.report.status == SolveStatus::kConverged ? "1" : "0";
    row["iterations"] = std::to_string(cold.report.iterations);
    row["error"] =
        number(squared_error(problem, cold.weights, optimum.weights) / *options.tolerance);
    options = options_for<Dim>(context, smoothness);
    const auto usual = solve(problem.cage, problem.mesh, options, coarse_mesher<Dim>()).report;
    row["default_iterations"] = std::to_string(usual.iterations);
    row["default_seconds"] = number(seconds_of(usual));
    lines += table.line(row);
  }
  auto row = mesh_row(setting);
  row["smoothness"] = "harmonic";
  auto options = options_for<Dim>(context, 0);
  options.method = Method::kHarmonic;
  add_quality(row, setting, posed, solve(problem, options));
  return lines + table.line(row);
}

}  // namespace

bool run_smoothness(const Context& context) {
  ResultTable table(context, "smoothness",
                    joined({mesh_columns(),
                            {"smoothness", "converged", "iterations", "error", "default_iterations",
                             "default_seconds", "mean_influences", "gradient_jump", "crease_mean",
                             "crease_high", "crease_largest"}}));
  for (const auto& model : models()) {
    table.add(in_setting(context, "smoothness", model,
                         context.size(model.dim, model.dim == 2 ? 10000 : 6000),
                         [&](const auto& setting) { return measure(context, table, setting); }));
  }
  return table.write(
      "value: iterations to 1e-7 from a cold start, error: true squared error relative to that; "
      "default: from cage and mesh with coarser meshes; jumps and creases: of the optimum, "
      "creases in degrees where the control points move at random by 5 % of the size");
}

}  // namespace flbc::bench

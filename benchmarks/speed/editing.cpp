// SPDX-License-Identifier: BSD-3-Clause
// Solves again after the rest cage has moved, from the solve before and from a cold start.
#include "flbc/solver.h"

#include <algorithm>
#include <cmath>
#include <random>

#include "flbc/bounding_box.h"
#include "flbc/errors.h"
#include "paper/experiments.h"
#include "paper/references.h"
#include "paper/result_table.h"
#include "paper/run_columns.h"

namespace flbc::bench {
namespace {

struct Size {
  const char* model;
  Index vertices;
};
constexpr Size kSizes[] = {{"woody", 2000}, {"horse", 6000}};

enum class Kind { kOne, kAll, kBend };

struct Move {
  const char* name;
  Kind kind;
  double part;  // of the cage's size
};
constexpr Move kMoves[] = {{"one control point by 0.1 %", Kind::kOne, 0.001},
                           {"one control point by 1 %", Kind::kOne, 0.01},
                           {"one control point by 5 %", Kind::kOne, 0.05},
                           {"all at random by up to 0.1 %", Kind::kAll, 0.001},
                           {"all at random by up to 1 %", Kind::kAll, 0.01},
                           {"a bend by 1 %", Kind::kBend, 0.01}};
constexpr int kDragSteps = 50;
constexpr int kQuickSteps = 5;
constexpr double kDragPart = 0.001;  // of the cage's size, per step

template <int Dim>
PointList<Dim> with_one_moved(const PointList<Dim>& points, const Model& model, double length) {
  PointList<Dim> moved = points;
  moved.col(model.control_point) += length * Vector<Dim>::LinSpaced(0.9, 0.3).normalized();
  return moved;
}

template <int Dim>
PointList<Dim> moved_by(const PointList<Dim>& points, const Model& model, const Move& move) {
  const double size = bounding_box_diagonal(points);
  const double length = move.part * size;
  if (move.kind == Kind::kOne) return with_one_moved<Dim>(points, model, length);
  PointList<Dim> moved = points;
  if (move.kind == Kind::kBend) {
    moved.row(1).array() += length * (4 / size * points.row(0).array()).sin();
    return moved;
  }
  std::mt19937 random(1);
  std::uniform_real_distribution<double> part(-1 / std::sqrt(Dim), 1 / std::sqrt(Dim));
  for (Eigen::Index k = 0; k < moved.cols(); ++k) {
    for (int axis = 0; axis < Dim; ++axis) moved(axis, k) += length * part(random);
  }
  return moved;
}

template <int Dim>
void add_cold(const Context& context, const Solver<Dim>& solver,
              const SolverOptions& options, Row& row) {
  const auto cold = solve(solver.cage(), solver.mesh(), options);
  const auto optimum = solve(solver.cage(), solver.mesh(),
                             optimum_options(context, NonNegative::kConstraint));
  const auto problem =
      make_problem(solver.cage(), solver.mesh(), DistanceScheme::kConstant);
  const auto error = [&](const WeightMatrix& weights) {
    return number(squared_error(problem, weights, optimum.weights));
  };
  row["cold_iterations"] = std::to_string(cold.report.iterations);
  row["cold_seconds"] = number(seconds_of(cold.report));
  row["cold_error"] = error(cold.weights);
  row["error"] = error(solver.solution().weights);
}

template <int Dim>
Row after(const Context& context, const Setting<Dim>& setting, const SolverOptions& options,
          const Move& move) {
  auto row = mesh_row(setting);
  row["move"] = move.name;
  const auto& cage = setting.problem.cage;
  Solver<Dim> solver(cage, setting.problem.mesh, options, coarse_mesher<Dim>());
  solver.solve();
  try {
    const auto& report = solver.move(moved_by<Dim>(cage.points, setting.model, move)).report;
    row["iterations"] = std::to_string(report.iterations);
    row["seconds"] = number(seconds_of(report));
  } catch (const InputError&) {  // a cell would turn over
    return row;
  }
  add_cold(context, solver, options, row);
  return row;
}

// Means over the steps of a drag.
template <int Dim>
Row drag(const Context& context, const Setting<Dim>& setting, const SolverOptions& options) {
  const auto& cage = setting.problem.cage;
  Solver<Dim> solver(cage, setting.problem.mesh, options, coarse_mesher<Dim>());
  solver.solve();
  const double length = kDragPart * bounding_box_diagonal(cage.points);
  const int steps = context.quick ? kQuickSteps : kDragSteps;
  double iterations = 0, seconds = 0, longest = 0;
  for (int step = 1; step <= steps; ++step) {
    const auto& report =
        solver.move(with_one_moved<Dim>(cage.points, setting.model, step * length)).report;
    iterations += report.iterations;
    seconds += seconds_of(report);
    longest = std::max(longest, seconds_of(report));
  }
  auto row = mesh_row(setting);
  row["move"] = "a drag by 0.1 % a step: mean of " + std::to_string(steps);
  row["iterations"] = number(iterations / steps);
  row["seconds"] = number(seconds / steps);
  row["longest_seconds"] = number(longest);
  add_cold(context, solver, options, row);
  return row;
}

template <int Dim>
std::string measure(const Context& context, const ResultTable& table, const Setting<Dim>& setting) {
  SolverOptions options;
  options.threads = context.threads;
  std::string lines;
  for (const auto& move : kMoves) {
    if (context.quick && move.part != 0.001) continue;
    lines += table.line(after(context, setting, options, move));
  }
  return lines + table.line(drag(context, setting, options));
}

}  // namespace

bool run_editing(const Context& context) {
  ResultTable table(context, "editing",
                    joined({mesh_columns(),
                            {"move", "iterations", "seconds", "longest_seconds", "error",
                             "cold_iterations", "cold_seconds", "cold_error"}}));
  for (const auto& size : kSizes) {
    const auto& chosen = model(size.model);
    table.add(in_setting(context, "editing", chosen, context.size(chosen.dim, size.vertices),
                         [&](const auto& setting) { return measure(context, table, setting); }));
  }
  return table.write(
      "value by default after a move of the rest cage, relative to its size: from the solve "
      "before, "
      "and from a cold start on the same mesh; set-up included; errors: mean squared");
}

}  // namespace flbc::bench

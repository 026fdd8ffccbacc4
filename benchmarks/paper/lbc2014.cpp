// SPDX-License-Identifier: BSD-3-Clause
// The influence of the 2014 solver's open details: `lbc2014` with its published penalty, and with
// one detail at a time otherwise. The iterations are those that compact_splitting_test compares
// with a literal implementation of problem (2).
#include <vector>

#include "flbc/harmonic.h"
#include "flbc/non_negative.h"
#include "flbc/solver.h"
#include "mesh/cell_geometry.h"
#include "paper/experiments.h"
#include "paper/open_details.h"
#include "problem/barycentric_constraints.h"
#include "solver/methods/splitting/compact_splitting.h"
#include "solver/plan/choices.h"

namespace flbc::bench {
namespace {

enum class From { kHarmonic, kHarmonicWithoutDuals, kLeastNorm };

struct Variant {
  const char* name;
  From start = From::kHarmonic;
  double penalty = 10;
  double relaxation = 1.65;
  double cell_power = 2;     // a cell's constraint weighs its measure to this power
  double vertex_weight = 1;  // of W = w; 0: w may be negative
  int check_interval = 10;
  bool in_double = false;
  bool projected = true;  // rows at the end
};

std::vector<Variant> variants() {
  std::vector<Variant> all;
  const auto add = [&](const char* name, const auto& change) {
    Variant variant{name};
    change(variant);
    all.push_back(variant);
  };
  add("--penalty 10", [](Variant&) {});
  add("residuals every iteration", [](Variant& v) { v.check_interval = 1; });
  add("double precision", [](Variant& v) { v.in_double = true; });
  add("rows not projected at the end", [](Variant& v) { v.projected = false; });
  add("duals 0 at the start", [](Variant& v) { v.start = From::kHarmonicWithoutDuals; });
  add("least-norm weights and duals 0 at the start",
      [](Variant& v) { v.start = From::kLeastNorm; });
  add("no over-relaxation", [](Variant& v) { v.relaxation = 1; });
  add("no W", [](Variant& v) { v.vertex_weight = 0; });
  add("W = w weighs 0.01", [](Variant& v) { v.vertex_weight = 0.01; });
  add("W = w weighs 100", [](Variant& v) { v.vertex_weight = 100; });
  add("cells weigh 1", [](Variant& v) { v.cell_power = 0; });
  add("penalty 1", [](Variant& v) { v.penalty = 1; });
  add("penalty 100", [](Variant& v) { v.penalty = 100; });
  return all;
}

template <int Dim>
splitting::Metric metric_of(const LbcProblem<Dim>& problem, const Variant& variant) {
  splitting::Metric metric;
  metric.cell = cell_measures(problem.mesh).array().pow(variant.cell_power);
  if (variant.vertex_weight > 0) {
    metric.vertex = Eigen::VectorXd::Constant(problem.mesh.num_vertices(), variant.vertex_weight);
  }
  return metric;
}

// The least-norm solution H of the constraints at every interior vertex.
template <int Dim>
WeightMatrix least_norm_weights(const LbcProblem<Dim>& problem) {
  const BarycentricConstraints<Dim> constraints(problem.cage.points);
  WeightMatrix weights =
      WeightMatrix::Zero(problem.num_control_points(), problem.mesh.num_vertices());
  problem.boundary.impose_on(weights);
  for (const Index v : problem.boundary.interior_vertices()) {
    constraints.project_weights(problem.mesh.points.col(v), weights.col(v));
  }
  return weights;
}

template <class Scalar, int Dim>
void start(compact::CompactSplitting<Scalar, Dim>& iteration, const LbcProblem<Dim>& problem,
           const Variant& variant) {
  const bool least_norm = variant.start == From::kLeastNorm;
  const auto weights = least_norm ? least_norm_weights(problem) : harmonic_coordinates(problem);
  if (variant.start == From::kHarmonic) {
    iteration.start_from_weights(weights);
    return;
  }
  Start<Dim> without_duals;
  without_duals.weights = [&](Index v) -> Eigen::VectorXd { return weights.col(v); };
  without_duals.flux_density = [n = weights.rows()](Index) {
    return Eigen::Matrix<double, Eigen::Dynamic, Dim>::Zero(n, Dim).eval();
  };
  iteration.start(without_duals);
}

template <class Scalar, int Dim>
void measure_in(const Setting<Dim>& setting, const WeightMatrix& optimum, const Variant& variant,
                int last, Row& row) {
  // In published units, in which W = w weighs 1.
  auto problem = setting.problem;
  const double length = plan::published_scale(problem.mesh);
  problem.cage.points *= length;
  problem.mesh.points *= length;
  compact::Settings settings;
  settings.penalty = variant.penalty;
  settings.relaxation = variant.relaxation;
  settings.paper_residuals = true;
  compact::CompactSplitting<Scalar, Dim> iteration(problem, metric_of(problem, variant), settings);
  start(iteration, problem, variant);
  const auto error = [&] {
    auto weights = iteration.all_weights();
    if (variant.projected) {
      project_non_negative(problem.cage.points, problem.mesh.points, weights,
                           problem.boundary.interior_vertices());
    }
    return squared_error(problem, weights, optimum);
  };
  run_to_thresholds(
      row, 1, variant.check_interval, last, [&] { return iteration.iterate(1, true); }, error);
}

}  // namespace

bool run_lbc2014(const Context& context) {
  return run_open_details(
      context, "lbc2014", {"woody", "horse"}, variants(),
      "the 2014 solver with its published penalty, and one detail at a time otherwise",
      [](auto scalar, const auto& setting, auto&... rest) {
        measure_in<decltype(scalar)>(setting, rest...);
      });
}

}  // namespace flbc::bench

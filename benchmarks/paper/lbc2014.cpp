// SPDX-License-Identifier: BSD-3-Clause
// The influence of the 2014 solver's open details: `lbc2014` with its published penalty, and with
// one detail at a time otherwise. The iterations are those that weight_splitting_test holds against
// a literal implementation of problem (2).
#include <algorithm>
#include <array>
#include <limits>
#include <vector>

#include "flbc/harmonic.h"
#include "flbc/non_negative.h"
#include "flbc/solver.h"
#include "paper/experiments.h"
#include "paper/references.h"
#include "paper/result_table.h"
#include "paper/run_columns.h"
#include "problem/barycentric_constraints.h"
#include "solver/splitting/weight_splitting.h"

namespace flbc::bench {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();
constexpr std::array<int, 3> kMarks = {100, 300, 1000};  // iterations whose error is told
constexpr int kLast = 2000;

enum class Start { kHarmonic, kHarmonicWithoutDuals, kLeastNorm };

struct Variant {
  const char* name;
  Start start = Start::kHarmonic;
  double penalty = 10;
  double relaxation = 1.65;
  double cell_power = 2;     // a cell's constraint weighs its measure to this power
  double vertex_weight = 1;  // of W = w; 0: w may be negative
  double largest_weight = kInfinite;
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
  add("0 <= W <= 1", [](Variant& v) { v.largest_weight = 1; });
  add("rows not projected at the end", [](Variant& v) { v.projected = false; });
  add("duals 0 at the start", [](Variant& v) { v.start = Start::kHarmonicWithoutDuals; });
  add("least-norm weights and duals 0 at the start",
      [](Variant& v) { v.start = Start::kLeastNorm; });
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
  metric.cell = splitting::cell_measures(problem.mesh).array().pow(variant.cell_power);
  if (variant.vertex_weight > 0) {
    metric.vertex = Eigen::VectorXd::Constant(problem.mesh.num_vertices(), variant.vertex_weight);
  }
  metric.largest_weight = variant.largest_weight;
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
void start(splitting::WeightSplitting<Scalar, Dim>& iteration, const LbcProblem<Dim>& problem,
           const Variant& variant) {
  const bool least_norm = variant.start == Start::kLeastNorm;
  const auto weights = least_norm ? least_norm_weights(problem) : harmonic_coordinates(problem);
  if (variant.start == Start::kHarmonic) {
    iteration.start_from_weights(weights);
  } else {
    iteration.start_without_duals(weights);
  }
}

template <class Scalar, int Dim>
Row measure_in(const Setting<Dim>& setting, const WeightMatrix& optimum, const Variant& variant,
               int last) {
  constexpr double kThreshold = 1e-7;  // of the primal residual, a tenth of that of the dual one
  const auto& problem = setting.problem;
  splitting::WeightSplitting<Scalar, Dim> iteration(problem, metric_of(problem, variant),
                                                    variant.penalty, variant.relaxation);
  start(iteration, problem, variant);
  const auto error = [&] {
    auto weights = iteration.weights();
    if (variant.projected) {
      project_non_negative(problem.cage.points, problem.mesh.points, weights,
                           problem.boundary.interior_vertices());
    }
    return number(squared_error(problem, weights, optimum));
  };
  const double threshold = kThreshold * iteration.num_residual_components();
  auto row = mesh_row(setting);
  row["variant"] = variant.name;
  bool stopped = false;
  for (int k = 1; k <= last && !(stopped && k > kMarks.back()); ++k) {
    const auto residuals = iteration.iterate_with_residuals();
    const bool within = residuals.primal <= threshold && residuals.dual <= 10 * threshold;
    if (!stopped && k >= 10 && k % variant.check_interval == 0 && within) {
      stopped = true;
      row["iterations"] = std::to_string(k);
      row["error"] = error();
    }
    const auto mark = std::find(kMarks.begin(), kMarks.end(), k);
    if (mark != kMarks.end()) row["error_" + std::to_string(k)] = error();
  }
  return row;
}

}  // namespace

bool run_lbc2014(const Context& context) {
  std::vector<std::string> columns = {"variant", "iterations", "error"};
  for (const int mark : kMarks) columns.push_back("error_" + std::to_string(mark));
  ResultTable table(context, "lbc2014", joined({mesh_columns(), columns}));
  for (const char* name : {"woody", "horse"}) {
    const auto& chosen = model(name);
    const Index vertices = context.size(chosen.dim, chosen.paper_size);
    for (const auto& variant : variants()) {
      const auto what = std::string("lbc2014, ") + variant.name;
      table.add(in_setting(context, what, chosen, vertices, [&](const auto& setting) {
        const auto optimum = reference(context, setting).weights;
        const int last = context.quick ? kMarks.front() : kLast;
        return table.line(variant.in_double ? measure_in<double>(setting, optimum, variant, last)
                                            : measure_in<float>(setting, optimum, variant, last));
      }));
    }
  }
  return table.write(
      "the 2014 solver with its published penalty, and one detail at a time otherwise: iterations "
      "after which it stops by the thresholds of section 5, mean squared error then and after so "
      "many iterations; no iterations: not within " +
      std::to_string(kLast));
}

}  // namespace flbc::bench

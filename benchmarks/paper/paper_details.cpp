// SPDX-License-Identifier: BSD-3-Clause
// The influence of what the paper leaves open: its iteration with one detail at a time otherwise.
#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "flbc/harmonic.h"
#include "flbc/recovery.h"
#include "paper/experiments.h"
#include "paper/references.h"
#include "paper/result_table.h"
#include "paper/run_columns.h"
#include "problem/barycentric_constraints.h"
#include "problem/domain_scale.h"
#include "solver/gradient/gradient_admm.h"

namespace flbc::bench {
namespace {

constexpr std::array<int, 3> kMarks = {100, 300, 1000};  // iterations whose error is told
constexpr int kLast = 2000;

enum class Start { kLeastNorm, kZero, kHarmonic };

struct Variant {
  const char* name;
  double radius = 250;  // of the farthest vertex
  Start start = Start::kLeastNorm;
  int check_interval = 1;
  bool in_double = false;
};
constexpr Variant kVariants[] = {
    {"R = 250; least-norm start; residuals every iteration"},
    {"residuals every 10 iterations (`paper`)", 250, Start::kLeastNorm, 10},
    {"residuals every 100 iterations", 250, Start::kLeastNorm, 100},
    {"double precision", 250, Start::kLeastNorm, 1, true},
    {"gradients start at 0", 250, Start::kZero},
    {"harmonic start", 250, Start::kHarmonic},
    {"R = 500", 500},
    {"R = 125", 125},
    {"R = 100", 100},
    {"R = 50", 50},
    {"R = 1", 1}};

// The same problem with its farthest vertex at this radius.
template <int Dim>
LbcProblem<Dim> scaled(LbcProblem<Dim> problem, double radius) {
  const double factor = radius / DomainScale<Dim>::kRadius;
  problem.cage.points *= factor;
  problem.mesh.points *= factor;
  return problem;
}

template <class Scalar, int Dim>
void start(gradient::GradientAdmm<Scalar, Dim>& admm, const LbcProblem<Dim>& problem, Start start) {
  if (start == Start::kLeastNorm) {
    admm.start_from_least_norm();
  } else if (start == Start::kHarmonic) {
    admm.start_from_weights(harmonic_coordinates(problem));
  } else {
    admm.start_from_weights(
        WeightMatrix::Zero(problem.num_control_points(), problem.mesh.num_vertices()));
  }
}

template <class Scalar, int Dim>
Row measure_in(const Setting<Dim>& setting, const WeightMatrix& optimum, const Variant& variant,
               int last) {
  constexpr double kThreshold = 1e-7;  // of the primal residual, a tenth of that of the dual one
  constexpr double kPenalty = Dim == 2 ? 100 : 10000;
  const auto problem = scaled(setting.problem, variant.radius);
  gradient::GradientAdmm<Scalar, Dim> admm(problem, kPenalty, 1, {});
  start(admm, problem, variant.start);
  const BarycentricConstraints<Dim> constraints(problem.cage.points);
  const auto error = [&] {
    auto weights = integrate_breadth_first(problem, admm.gradients());
    for (const Index v : problem.boundary.interior_vertices()) {
      constraints.project_weights(problem.mesh.points.col(v), weights.col(v));
    }
    return number(squared_error(problem, weights, optimum));
  };
  const double threshold = kThreshold * admm.num_residual_components();
  auto row = mesh_row(setting);
  row["variant"] = variant.name;
  bool stopped = false;
  for (int k = 1; k <= last && !(stopped && k > kMarks.back()); ++k) {
    const auto residuals = admm.residuals(admm.iterate());
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

bool run_paper_details(const Context& context) {
  std::vector<std::string> columns = {"variant", "iterations", "error"};
  for (const int mark : kMarks) columns.push_back("error_" + std::to_string(mark));
  ResultTable table(context, "paper_details", joined({mesh_columns(), columns}));
  for (const char* name : {"woody", "cactus", "logo", "horse"}) {
    const auto& chosen = model(name);
    const Index vertices = context.size(chosen.dim, chosen.paper_size);
    for (const auto& variant : kVariants) {
      const auto what = std::string("paper_details, ") + variant.name;
      table.add(in_setting(context, what, chosen, vertices, [&](const auto& setting) {
        const auto optimum = reference(context, setting).weights;
        const int last = context.quick ? kMarks.front() : kLast;
        return table.line(variant.in_double ? measure_in<double>(setting, optimum, variant, last)
                                            : measure_in<float>(setting, optimum, variant, last));
      }));
    }
  }
  return table.write(
      "the paper's iteration with one open detail at a time otherwise: iterations after which it "
      "stops by the thresholds of section 4.2.1, mean squared error then and after so many "
      "iterations; no iterations: not within " +
      std::to_string(kLast) + "; nothing of this depends on the machine");
}

}  // namespace flbc::bench

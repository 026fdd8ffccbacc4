// SPDX-License-Identifier: BSD-3-Clause
// The influence of what the paper leaves open: its iteration with one detail at a time otherwise.
#include "flbc/harmonic.h"
#include "flbc/recovery.h"
#include "paper/experiments.h"
#include "paper/open_details.h"
#include "problem/barycentric_constraints.h"
#include "solver/methods/gradient/gradient_admm.h"
#include "solver/plan/choices.h"

namespace flbc::bench {
namespace {

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
  const double factor = radius / 250 * plan::published_scale(problem.mesh);
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
void measure_in(const Setting<Dim>& setting, const WeightMatrix& optimum, const Variant& variant,
                int last, Row& row) {
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
    return squared_error(problem, weights, optimum);
  };
  run_to_thresholds(
      row, admm.num_residual_components(), variant.check_interval, last,
      [&] { return admm.residuals(admm.iterate()); }, error);
}

}  // namespace

bool run_paper_details(const Context& context) {
  return run_open_details(context, "paper_details", {"woody", "cactus", "logo", "horse"}, kVariants,
                          "the paper's iteration with one open detail at a time otherwise",
                          [](auto scalar, const auto& setting, auto&... rest) {
                            measure_in<decltype(scalar)>(setting, rest...);
                          });
}

}  // namespace flbc::bench

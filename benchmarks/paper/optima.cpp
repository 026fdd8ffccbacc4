// SPDX-License-Identifier: BSD-3-Clause
// Every method, with and without w >= 0, beside optima that an interior-point method found.
#include <omp.h>

#include <algorithm>
#include <stdexcept>
#include <variant>

#include "flbc/io/cage_io.h"
#include "flbc/io/model_file.h"
#include "flbc/solver.h"
#include "paper/experiments.h"
#include "paper/methods.h"
#include "paper/result_table.h"
#include "paper/setting.h"
#include "support/model_optimum.h"

namespace flbc::bench {
namespace {

struct Case {
  Model model;
  Index vertices;        // of the reference's mesh
  int fewer_iterations;  // of value and of the tuned 2014 solver
};

std::vector<Case> cases() {
  return {{model("woody"), 2000, 1500},
          {Model{"clothing", 3, "3d/clothing_cage.obj", 0, 0, 0}, 1000, 3000}};
}

constexpr int kIterations = 6000;
constexpr int kQuickIterations = 200;

double largest_difference(const std::vector<Eigen::VectorXd>& a,
                          const std::vector<Eigen::VectorXd>& b) {
  double largest = 0;
  for (std::size_t k = 0; k < a.size(); ++k) {
    largest = std::max(largest, (a[k] - b[k]).cwiseAbs().maxCoeff());
  }
  return largest;
}

// gradient and paper minimise without the constraint and project their rows onto it.
NonNegative constraint_of(Method method) {
  const bool splits = method == Method::kValue || method == Method::kLbc2014;
  return splits ? NonNegative::kConstraint : NonNegative::kProject;
}

const char* word_of(NonNegative non_negative) {
  if (non_negative == NonNegative::kOff) return "no";
  return non_negative == NonNegative::kProject ? "projected" : "yes";
}

int iterations_of(const Context& context, const Case& chosen, const NamedMethod& method) {
  if (context.quick) return kQuickIterations;
  const bool fast = method.method == Method::kValue || std::string(method.name) == "lbc2014-tuned";
  return fast ? chosen.fewer_iterations : kIterations;
}

template <int Dim>
Row compare(const Context& context, const Case& chosen, const LbcProblem<Dim>& problem,
            const testing::ModelReference<Dim>& reference, const NamedMethod& method,
            NonNegative non_negative) {
  auto options = method.options(problem, context.threads);
  options.non_negative = non_negative;
  options.precision = Precision::kDouble;
  options.tolerance = 1e-30;  // never: run to the end
  options.max_iterations = iterations_of(context, chosen, method);
  options.certify = true;
  const auto [weights, sparse, report] = solve(problem, options);
  const bool off = non_negative == NonNegative::kOff;
  const auto& optimum = off ? reference.without() : reference.with();
  const auto sampled = reference.sampled(weights);
  // The bound is one of non-negative weights.
  const double bounded = reference.with().objective;
  return {
      {"model", chosen.model.name},
      {"control_points", std::to_string(problem.num_control_points())},
      {"vertices", std::to_string(problem.mesh.num_vertices())},
      {"method", method.name},
      {"non_negative", word_of(non_negative)},
      {"iterations", std::to_string(report.iterations)},
      {"objective_above", number(report.objective / optimum.objective - 1)},
      {"squared_difference", number(testing::mean_squared_difference(sampled, optimum.weights))},
      {"largest_difference", number(largest_difference(sampled, optimum.weights))},
      {"bound_below", number(1 - report.certificate.lower_bound / bounded)}};
}

template <int Dim>
std::string measure(const Context& context, const ResultTable& table, const Case& chosen,
                    const Cage<Dim>& cage) {
  const auto reference = testing::read_model_reference<Dim>(FLBC_TEST_DATA_DIR, chosen.model.name);
  const auto mesh = mesh_of(cage, chosen.vertices);
  if (!reference.belongs_to(mesh)) throw std::runtime_error("another mesh than the reference's");
  auto problem = make_problem(cage, mesh, DistanceScheme::kConstant);
  problem.phi = testing::euclidean_phi(cage.points, mesh);
  std::string lines;
  for (const auto& method : methods()) {
    for (const auto non_negative : {NonNegative::kOff, constraint_of(method.method)}) {
      lines += table.line(compare(context, chosen, problem, reference, method, non_negative));
    }
  }
  return lines;
}

}  // namespace

bool run_optima(const Context& context) {
  ResultTable table(context, "optima",
                    {"model", "control_points", "vertices", "method", "non_negative", "iterations",
                     "objective_above", "squared_difference", "largest_difference", "bound_below"});
  for (const auto& chosen : cases()) {
    if (!context.wants(chosen.model.name)) continue;
    const auto what = std::string("optima: ") + chosen.model.name;
    std::printf("%s\n", what.c_str());
    table.add(in_child(what, [&] {
      omp_set_num_threads(context.threads);
      const auto file = cage_path(context, chosen.model);
      const auto any = io::to_cage(io::read_polygons(file), file);
      return std::visit([&](const auto& cage) { return measure(context, table, chosen, cage); },
                        any);
    }));
  }
  return table.write(
      "methods in double precision after many iterations, beside the optima of an interior-point "
      "method on the same mesh: objective and bound relative to its objective, differences of the "
      "weights at the vertices kept; nothing of this depends on the machine");
}

}  // namespace flbc::bench

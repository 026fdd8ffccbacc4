// SPDX-License-Identifier: BSD-3-Clause
// A short description of what the library computes. Results carry it, so that tables of an earlier
// behavior are found.
#include <cstdio>

#include "experiments.h"
#include "flbc/report.h"
#include "problems.h"

namespace flbc::bench {
namespace {

constexpr Index kVertices = 1500;

// Squares, because sums of weights are 1. Control points count differently, so that an exchange of
// two is seen.
std::string entry(const std::string& name, int iterations, const SparseWeights& weights) {
  double sum = 0;
  for (Index p = 0; p < weights.num_points(); ++p) {
    const Eigen::VectorXd row = weights.at(p);
    sum += row.cwiseAbs2().dot(Eigen::VectorXd::LinSpaced(row.size(), 1, 2));
  }
  char text[64];
  std::snprintf(text, sizeof text, "%s %d/%.5f", name.c_str(), iterations,
                sum / weights.num_points());
  return text;
}

template <int Dim>
std::string solved(const std::string& name, const Cage<Dim>& cage, const SolverOptions& options) {
  const auto mesh = mesh_of(cage, kVertices);
  const auto solution = solve(cage, mesh, options);
  return entry(name, solution.report.iterations, solution.weights);
}

template <int Dim>
std::string sample(const std::string& name) {
  const auto folder = "meshes/" + std::to_string(Dim) + "d/";
  const auto cage = read_cage<Dim>(folder + name + "_cage.obj");
  SolverOptions options;
  options.threads = 1;
  const auto smooth = solved(name + " smooth", cage, options);
  options.smoothness = 0;
  return solved(name, cage, options) + ", " + smooth;
}

// The published methods, and the gradient ADMM.
std::string published() {
  const auto cage = read_cage<3>("meshes/3d/limb_cage.obj");
  SolverOptions options;
  options.threads = 1;
  options.max_iterations = 100;
  std::string text;
  for (const auto method : {Method::kLbc2014, Method::kPaper, Method::kGradient}) {
    options.method = method;
    text += ", " + solved(std::string("limb ") + name_of(method), cage, options);
  }
  return text;
}

}  // namespace

std::string behavior() {
  return sample<2>("figure") + ", " + sample<3>("limb") + published();
}

}  // namespace flbc::bench

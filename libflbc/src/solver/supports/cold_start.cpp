// SPDX-License-Identifier: BSD-3-Clause
#include "solver/supports/cold_start.h"

#include <memory>

#include "coordinates/poisson_weights.h"

namespace flbc::supports {

template <int Dim>
DualStart<Dim> cold_start(const LbcProblem<Dim>& problem, LinearSolver linear_solver) {
  const DirichletProblem<Dim> laplace(problem.mesh, problem.boundary, linear_solver);
  const auto weights = std::make_shared<const WeightMatrix>(harmonic_coordinates(problem, laplace));
  DualStart<Dim> start;
  start.weights = [weights](Index v) -> Eigen::VectorXd { return weights->col(v); };
  start.flux_density = [n = problem.num_control_points()](Index) {
    return Eigen::Matrix<double, Eigen::Dynamic, Dim>::Zero(n, Dim).eval();
  };
  return start;
}

template DualStart<2> cold_start(const LbcProblem<2>&, LinearSolver);
template DualStart<3> cold_start(const LbcProblem<3>&, LinearSolver);

}  // namespace flbc::supports

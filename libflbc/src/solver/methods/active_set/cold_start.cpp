// SPDX-License-Identifier: BSD-3-Clause
#include "solver/methods/active_set/cold_start.h"

#include <utility>

#include "coordinates/poisson_weights.h"
#include "solver/plan/constants.h"

namespace flbc::active_set {

template <int Dim>
Start<Dim> ColdStart<Dim>::state() const {
  Start<Dim> start;
  start.weights = [all = weights](Index v) -> Eigen::VectorXd {
    return all->col(v).template cast<double>();
  };
  start.flux_density = [n = weights->rows()](Index) {
    return Eigen::Matrix<double, Eigen::Dynamic, Dim>::Zero(n, Dim).eval();
  };
  return start;
}

template <int Dim>
ColdStart<Dim> cold_start(const LbcProblem<Dim>& problem, LinearSolver linear_solver) {
  const DirichletProblem<Dim> laplace(problem.mesh, problem.boundary, linear_solver);
  ColdStart<Dim> cold;
  cold.weights = std::make_shared<const Eigen::MatrixXf>(
      harmonic_coordinates(problem, laplace).template cast<float>());
  cold.active = active_of(problem, cold.state().weights, plan::kLeastHarmonic);
  return cold;
}

template struct ColdStart<2>;
template struct ColdStart<3>;
template ColdStart<2> cold_start(const LbcProblem<2>&, LinearSolver);
template ColdStart<3> cold_start(const LbcProblem<3>&, LinearSolver);

}  // namespace flbc::active_set

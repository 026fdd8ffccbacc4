// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/harmonic.h"

#include "coordinates/poisson_weights.h"

namespace flbc {

template <int Dim>
WeightMatrix harmonic_coordinates(const LbcProblem<Dim>& problem,
                                  const DirichletProblem<Dim>& poisson) {
  auto weights = poisson.solve(boundary_matrix(problem.boundary, problem.num_control_points()));
  project_interior(problem, weights);
  return weights;
}

template <int Dim>
WeightMatrix harmonic_coordinates(const LbcProblem<Dim>& problem) {
  return harmonic_coordinates(problem, DirichletProblem<Dim>(problem.mesh, problem.boundary));
}

#define FLBC_INSTANTIATE(Dim)                                         \
  template WeightMatrix harmonic_coordinates(const LbcProblem<Dim>&); \
  template WeightMatrix harmonic_coordinates(const LbcProblem<Dim>&, const DirichletProblem<Dim>&);
FLBC_INSTANTIATE(2)
FLBC_INSTANTIATE(3)
#undef FLBC_INSTANTIATE

}  // namespace flbc

// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/harmonic.h"

#include "coordinates/project_interior.h"
#include "problem/laplacian.h"

namespace flbc {

template <int Dim>
WeightMatrix harmonic_coordinates(const LbcProblem<Dim>& problem) {
  auto weights = DirichletProblem<Dim>(problem.mesh, problem.boundary)
                     .solve(boundary_matrix(problem.boundary, problem.num_control_points()));
  project_interior(problem, weights);
  return weights;
}

template WeightMatrix harmonic_coordinates(const LbcProblem<2>&);
template WeightMatrix harmonic_coordinates(const LbcProblem<3>&);

}  // namespace flbc

// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! How Method::kValue solves its linear systems where the user leaves it open.
#pragma once

#include "flbc/lbc_problem.h"
#include "flbc/options.h"

namespace flbc {

//! A factor of a large mesh takes more time and memory than the iteration itself; in 3D soon, in 2D
//! where meshes hardly get.
template <int Dim>
LinearSolver linear_solver_for(const LbcProblem<Dim>& problem, const SolverOptions& options) {
  constexpr Index kLargest = Dim == 2 ? 2000000 : 20000;  // vertices
  if (options.linear_solver != LinearSolver::kAuto) return options.linear_solver;
  return problem.mesh.num_vertices() > kLargest ? LinearSolver::kMultigrid : LinearSolver::kDirect;
}

}  // namespace flbc

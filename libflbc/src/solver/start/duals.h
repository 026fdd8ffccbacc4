// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Weights and duals that outlive their iteration, in a form that other meshes understand.
#pragma once

#include "flbc/sparse_weights.h"
#include "solver/start/flux_densities.h"
#include "solver/start/start.h"

namespace flbc {

//! The state of an iteration as quantities that have a limit as meshes become finer: densities, not
//! numbers per cell. Lengths are those of the problem. n control points, V vertices, F cells.
template <int Dim>
struct Duals {
  double penalty = 0;                 //!< used last
  SparseWeights weights{};            //!< of V points
  FluxDensities<Dim> flux_density{};  //!< p_s / A_s, at most phi long
  //! q - w of the constraint u = w, u >= 0, without its zeros, of V points; for the penalty above.
  //! No points without the constraint.
  SparseWeights vertex_dual{};
};

//! Copies what a start refers to.
template <int Dim>
Duals<Dim> keep(const LbcProblem<Dim>& problem, const Start<Dim>& start) {
  const Index n = problem.num_control_points();
  const Index num_vertices = problem.mesh.num_vertices();
  Duals<Dim> duals;
  duals.flux_density = {n, problem.mesh.num_cells(), start.flux_density};
  duals.penalty = start.penalty;
  duals.weights = SparseWeights::of(n, num_vertices, with_known_values(problem, start.weights));
  if (!start.vertex_dual) return duals;
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(n);
  duals.vertex_dual = SparseWeights::of(n, num_vertices, [&](Index v) {
    return problem.boundary.is_interior(v) ? start.vertex_dual(v) : none;
  });
  return duals;
}

}  // namespace flbc

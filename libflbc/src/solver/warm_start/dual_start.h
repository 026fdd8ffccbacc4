// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Weights and duals to start from, one vertex or cell at a time, wherever they come from.
#pragma once

#include <memory>
#include <utility>

#include "flbc/lbc_problem.h"
#include "solver/warm_start/transfer.h"

namespace flbc {

//! Lengths are those of the problem that starts. What the functions refer to outlives them.
template <int Dim>
struct DualStart {
  double penalty = 0;             //!< that the vertex duals belong to
  VectorsAt<1> weights{};         //!< of an interior vertex, n numbers
  VectorsAt<Dim> flux_density{};  //!< p / A of a cell, n x Dim, at most phi long
  VectorsAt<1> vertex_dual{};     //!< q - w of an interior vertex, n numbers; null for none

  //! q - w for another penalty: the multiplier stays.
  VectorsAt<1> vertex_dual_at(double other) const {
    if (!vertex_dual) return {};
    return [dual = vertex_dual, factor = penalty / other](Index vertex) -> Eigen::VectorXd {
      return factor * dual(vertex);
    };
  }
};

//! Weights of any vertex, known ones on the boundary, by those of interior vertices.
template <int Dim>
VectorsAt<1> with_known_values(const LbcProblem<Dim>& problem, VectorsAt<1> weights) {
  return [&problem, weights = std::move(weights)](Index v) -> Eigen::VectorXd {
    if (problem.boundary.is_interior(v)) return weights(v);
    Eigen::VectorXd known = Eigen::VectorXd::Zero(problem.num_control_points());
    problem.boundary.scatter(problem.boundary.boundary_index[v], known);
    return known;
  };
}

//! The same start for an iteration with another penalty.
template <int Dim>
DualStart<Dim> with_penalty(DualStart<Dim> start, double penalty) {
  start.vertex_dual = start.vertex_dual_at(penalty);
  start.penalty = penalty;
  return start;
}

//! From another mesh.
template <int Dim>
DualStart<Dim> start_of(const Transfer<Dim>& transfer) {
  return {transfer.penalty(), [&](Index v) { return transfer.weights_at(v); },
          [&](Index s) { return transfer.flux_density(s); },
          transfer.vertex_dual_at(transfer.penalty())};
}

//! From where an iteration is, which is kept for as long as the start. \tparam Splitting  with the
//! functions used here
template <int Dim, class Splitting>
DualStart<Dim> start_of(std::shared_ptr<const Splitting> splitting) {
  DualStart<Dim> start;
  start.penalty = splitting->penalty();
  start.weights = [splitting](Index v) { return splitting->weights_at(v); };
  start.flux_density = [splitting](Index s) { return splitting->flux_density(s); };
  if (splitting->has_vertex_dual()) {
    start.vertex_dual = [splitting](Index v) { return splitting->vertex_dual_at(v); };
  }
  return start;
}

//! What a start holds, of its own.
template <int Dim>
MeshState<Dim> mesh_state(const LbcProblem<Dim>& problem, const DualStart<Dim>& start) {
  const Index n = problem.num_control_points();
  MeshState<Dim> state;
  state.flux_density = {n, problem.mesh.num_cells(), start.flux_density};
  state.penalty = start.penalty;
  state.weights =
      SparseWeights::of(n, problem.mesh.num_vertices(), with_known_values(problem, start.weights));
  if (!start.vertex_dual) return state;
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(n);
  state.vertex_dual = SparseWeights::of(n, problem.mesh.num_vertices(), [&](Index v) {
    return problem.boundary.is_interior(v) ? start.vertex_dual(v) : none;
  });
  return state;
}

}  // namespace flbc

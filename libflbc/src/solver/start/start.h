// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! The start of an iteration: access to weights and duals per vertex or cell, from any source.
#pragma once

#include <algorithm>
#include <cmath>
#include <utility>

#include "flbc/lbc_problem.h"

namespace flbc {

//! One vector per control point on a cell, n x Dim, as VectorsAt returns it.
template <int Dim>
using Vectors = Eigen::Matrix<double, Eigen::Dynamic, Dim>;

//! Views of weights and duals, in the units of the new problem. The data they refer to must outlive
//! them. Without `weights` the start is cold: an iteration then begins with its own weights, which
//! are harmonic coordinates or the least-norm solution.
template <int Dim>
struct Start {
  double penalty = 0;             //!< penalty of the vertex duals
  VectorsAt<1> weights{};         //!< of an interior vertex, n values
  VectorsAt<Dim> flux_density{};  //!< p / A of a cell, n x Dim, admissible
  VectorsAt<1> vertex_dual{};     //!< q - w of an interior vertex, n values; null: none

  bool is_cold() const { return !weights; }

  //! q - w for another penalty, with the same multiplier.
  VectorsAt<1> vertex_dual_at(double other) const {
    if (!vertex_dual) return {};
    return [dual = vertex_dual, factor = penalty / other](Index vertex) -> Eigen::VectorXd {
      return factor * dual(vertex);
    };
  }
};

//! Weights of any vertex, from the known boundary weights and those of interior vertices.
template <int Dim>
VectorsAt<1> with_known_values(const LbcProblem<Dim>& problem, VectorsAt<1> weights) {
  return [&problem, weights = std::move(weights)](Index v) -> Eigen::VectorXd {
    if (problem.boundary.is_interior(v)) return weights(v);
    Eigen::VectorXd known = Eigen::VectorXd::Zero(problem.num_control_points());
    problem.boundary.scatter(problem.boundary.boundary_index[v], known);
    return known;
  };
}

//! Makes p / A of a cell a dual of finite value: without smoothness, relaxed or transferred duals
//! may be longer than phi and are shortened. Checks for zero rows first, because evaluating phi
//! takes longer. \param density  n x Dim
template <int Dim, class Rows>
void make_admissible(const LbcProblem<Dim>& problem, Index cell, Rows& density) {
  if (problem.smoothness > 0) return;
  Eigen::ArrayXd squared = density.col(0).array().square();
  for (Eigen::Index d = 1; d < density.cols(); ++d) squared += density.col(d).array().square();
  for (Eigen::Index i = 0; i < density.rows(); ++i) {
    if (squared[i] > 0) {
      density.row(i) *= std::min(problem.phi(i, cell) / std::sqrt(squared[i]), 1.0);
    }
  }
}

}  // namespace flbc

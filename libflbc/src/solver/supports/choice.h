// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Where Method::kValue works on supports.
#pragma once

#include "flbc/lbc_problem.h"
#include "flbc/options.h"
#include "solver/supports/support_lists.h"

namespace flbc::supports {

//! Whether supports are to be looked for: where they pay, and nothing is asked for that they do not
//! give. \param n  number of control points
template <int Dim>
bool serve(Index n, Index num_vertices, const SolverOptions& options) {
  // Below, lists of control points are not much shorter than all of them, as measured; in 2D they
  // hold too few to leave the iteration freedom.
  constexpr Index kFewest = 80;
  if (options.method != Method::kValue || n > kMostControlPoints) return false;
  if (options.active_pairs != ActivePairs::kAuto) return options.active_pairs == ActivePairs::kOn;
  // Small meshes are fast as they are.
  constexpr double kFewestPairs = 4e5;
  if (static_cast<double>(n) * num_vertices < kFewestPairs) return false;
  return Dim == 3 && n >= kFewest && !options.certify;
}
template <int Dim>
bool serve(const LbcProblem<Dim>& problem, const SolverOptions& options) {
  return serve<Dim>(problem.num_control_points(), problem.mesh.num_vertices(), options);
}

//! Whether so many pairs take less time than all.
template <int Dim>
bool pay(const LbcProblem<Dim>& problem, const SolverOptions& options, const SupportLists& lists) {
  constexpr double kMost = 0.5;
  return options.active_pairs == ActivePairs::kOn || density(problem, lists) <= kMost;
}

}  // namespace flbc::supports

// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! The kinds of solvers of linear systems.
#pragma once

namespace flbc {

enum class LinearSolver {
  kDirect,    //!< one factorization, exact solves
  kMultigrid  //!< time and memory proportional to the mesh: one algebraic multigrid cycle per
              //!< iteration of a splitting, otherwise conjugate gradients preconditioned by cycles
};

}  // namespace flbc

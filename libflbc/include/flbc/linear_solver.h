// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! How symmetric positive definite systems are solved.
#pragma once

namespace flbc {

//! How Method::kValue and kLbc2014 solve the linear system of each iteration, and Method::kGradient
//! those of its start and its recovery.
enum class LinearSolver {
  kAuto,       //!< by what is faster: kMultigrid for kValue and kGradient on large meshes, else
               //!< kDirect
  kDirect,     //!< one factorisation, exact solves
  kMultigrid,  //!< time and memory grow as the mesh: a cycle of algebraic multigrid per iteration;
               //!< for kGradient conjugate gradients with such cycles
  kNone        //!< kGradient and kPaper only: no global system. The start is the least-norm solution
               //!< of the local constraints, the recovery breadth-first, as in the paper
};

}  // namespace flbc

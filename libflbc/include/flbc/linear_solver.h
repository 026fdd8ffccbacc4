// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! How symmetric positive definite systems are solved.
#pragma once

namespace flbc {

//! How Method::kValue and kLbc2014 solve their linear systems.
enum class LinearSolver {
  kAuto,      //!< by what is faster: kMultigrid for kValue on large meshes, else kDirect
  kDirect,    //!< one factorisation, exact solves
  kMultigrid  //!< a cycle of algebraic multigrid per iteration: time and memory grow as the mesh
};

}  // namespace flbc

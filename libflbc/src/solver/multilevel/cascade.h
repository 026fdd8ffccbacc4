// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Solving on coarser meshes of the same cage first, to start from there.
#pragma once

#include "flbc/coarse_to_fine.h"
#include "flbc/solver.h"

namespace flbc {

//! Solves a problem from the solution on coarser meshes, where level_sizes() finds any.
//! \param mesher  not empty
//! \param options  resolved, of a method that inherits() holds for
//! \param storage  of the state on the problem's own mesh, may be null
template <int Dim>
Solution solve_in_cascade(const LbcProblem<Dim>& problem, const CoarseMesher<Dim>& mesher,
                          const SolverOptions& options, StateStorage* storage);

}  // namespace flbc

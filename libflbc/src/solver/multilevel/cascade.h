// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Solving on coarser meshes of the same cage first, to start from there.
#pragma once

#include <vector>

#include "solver/iterative_method.h"
#include "solver/multilevel/coarse_problem.h"

namespace flbc {

//! Solves a problem from the solution on coarser meshes, each from that of the one before.
//! \param levels  coarsest first; none for a start without them
//! \param options  resolved, of a method that inherits() holds for if there are levels
//! \param storage  of the state on the problem's own mesh, may be null
//! \param final_state  where a method that inherits() holds for leaves it for other meshes; may be
//! null
template <int Dim>
MethodRun solve_in_cascade(const LbcProblem<Dim>& problem, std::vector<CoarseProblem<Dim>> levels,
                           const SolverOptions& options, StateStorage* storage = nullptr,
                           MeshState<Dim>* final_state = nullptr);

}  // namespace flbc

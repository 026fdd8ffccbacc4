// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Cages whose interior has several parts.
#pragma once

#include "flbc/solver.h"

namespace flbc {

//! Calls solve() or solve_sparse() for every part of the mesh with the control points that are its
//! vertices. \tparam Result  Solution or SparseSolution
//! \param options  valid
//! \throws InputError as solve(), and if the parts of mesh and cage are not the same
template <class Result, int Dim>
Result solve_parts(const Cage<Dim>& cage, const DomainMesh<Dim>& mesh, const SolverOptions& options,
                   const CoarseMesher<Dim>& mesher);

}  // namespace flbc

// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! From a problem to local barycentric coordinates.
#pragma once

#include "flbc/lbc_problem.h"
#include "flbc/options.h"
#include "flbc/report.h"
#include "flbc/solver_state.h"

namespace flbc {

//! Coordinates at the vertices of the domain mesh.
struct Solution {
  WeightMatrix weights;  //!< n x V
  SolveReport report;    //!< how it went
};

//! Solves a problem; several calls with different options may share it.
//! \param storage  where the iteration's state lives, to be kept or to go on from; null for memory
//! that is freed at the end
//! \throws OptionError, SolverError
template <int Dim>
Solution solve(const LbcProblem<Dim>& problem, const SolverOptions& options = {},
               StateStorage* storage = nullptr);

//! One call from cage and mesh to coordinates. \throws InputError, OptionError, SolverError
template <int Dim>
Solution solve(const Cage<Dim>& cage, const DomainMesh<Dim>& mesh,
               const SolverOptions& options = {});

}  // namespace flbc

// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! From a problem to local barycentric coordinates.
#pragma once

#include "flbc/lbc_problem.h"
#include "flbc/options.h"
#include "flbc/report.h"

namespace flbc {

//! Coordinates at the vertices of the domain mesh.
struct Solution {
  WeightMatrix weights;  //!< n x V
  SolveReport report;
};

//! Solves a problem; several calls with different options may share it.
//! \throws OptionError, SolverError
template <int Dim>
Solution solve(const LbcProblem<Dim>& problem, const SolverOptions& options = {});

//! One call from cage and mesh to coordinates. \throws InputError, OptionError, SolverError
template <int Dim>
Solution solve(const Cage<Dim>& cage, const DomainMesh<Dim>& mesh,
               const SolverOptions& options = {});

}  // namespace flbc

// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Harmonic coordinates, for comparison and as an initial guess.
#pragma once

#include "flbc/lbc_problem.h"

namespace flbc {

//! Harmonic coordinates (Joshi et al. 2007) on the domain mesh.
//! \param problem  mesh and boundary values
//! \return n x V
//! \throws SolverError if the Laplace equation cannot be solved
template <int Dim>
WeightMatrix harmonic_coordinates(const LbcProblem<Dim>& problem);

}  // namespace flbc

// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Measures of weights that need a mesh of the cage's interior.
#pragma once

#include "flbc/check.h"
#include "flbc/lbc_problem.h"

namespace flbc {

//! Local extrema, total variation and locality, beside those of harmonic coordinates.
//! \param problem  made of the mesh
//! \param domain  the mesh, in its own units
//! \param weights  n x V \param mean_influences  of the weights, as measure_quality() gives it
//! \throws SolverError
template <int Dim>
MeshCheck<Dim> check_on_mesh(const LbcProblem<Dim>& problem, const DomainMesh<Dim>& domain,
                             const WeightMatrix& weights, double mean_influences);

}  // namespace flbc

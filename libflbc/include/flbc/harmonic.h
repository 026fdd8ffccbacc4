// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Harmonic coordinates, for comparison and as an initial guess, and biharmonic weights.
#pragma once

#include "flbc/lbc_problem.h"

namespace flbc {

//! Harmonic coordinates (Joshi et al. 2007) on the domain mesh.
//! \param problem  mesh and boundary values
//! \return n x V
//! \throws SolverError if the Laplace equation cannot be solved
template <int Dim>
WeightMatrix harmonic_coordinates(const LbcProblem<Dim>& problem);

//! Bounded biharmonic weights (Jacobson et al. 2011) on the domain mesh. Each function minimizes
//! the Laplacian energy w^T L M^-1 L w / 2 with 0 <= w <= 1. On the cage it is linear on each facet
//! and 1 at its control point, as in the paper. The functions are minimized one by one and then
//! divided by their sum, which is the fast variant of the paper.
//! They do not reproduce linear functions. Add weighted displacements of the control points to the
//! rest points, x + sum_i w_i (c'_i - c_i), which keeps the rest pose.
//! As in the paper, L has rows for boundary vertices, which keep derivatives normal to the cage
//! small. Without these rows, harmonic coordinates would have zero energy.
//! \param problem  mesh and boundary values
//! \return n x V, each column sums to 1; accurate to 3e-6 on average and 1e-3 at a single vertex,
//! measured on models. The result does not depend on the number of threads
//! \throws SolverError if a linear system cannot be factored, or if the iteration does not converge
template <int Dim>
WeightMatrix bounded_biharmonic_weights(const LbcProblem<Dim>& problem);

}  // namespace flbc

// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Harmonic coordinates and least-squares recovery by a Poisson problem that is kept.
#pragma once

#include "flbc/lbc_problem.h"
#include "problem/laplacian.h"

namespace flbc {

//! harmonic_coordinates() of harmonic.h. \param poisson  of the problem's mesh
template <int Dim>
WeightMatrix harmonic_coordinates(const LbcProblem<Dim>& problem,
                                  const DirichletProblem<Dim>& poisson);

//! integrate_least_squares() of recovery.h. \param poisson  of the problem's mesh
template <class Scalar, int Dim>
WeightMatrix integrate_least_squares(const LbcProblem<Dim>& problem,
                                     const CellFieldView<Scalar, Dim>& gradients,
                                     const DirichletProblem<Dim>& poisson);

}  // namespace flbc

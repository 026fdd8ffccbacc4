// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! From gradients to weights.
#pragma once

#include "flbc/lbc_problem.h"

namespace flbc {

//! The paper's recovery (4.2.2): breadth-first search from the boundary divides the vertices into
//! levels; the weights of a level follow from the level before, w(v) = w(v') + g (v - v'), in
//! parallel. Where several edges lead to a vertex, and several cells lie at an edge, their values
//! are averaged in a fixed order.
//! \param problem  mesh and boundary values
//! \param gradients  a vector per cell and control point, 1 / units of the mesh
//! \return n x V
template <class Scalar, int Dim>
WeightMatrix integrate_breadth_first(const LbcProblem<Dim>& problem,
                                     const CellFieldView<Scalar, Dim>& gradients);

//! The weights whose gradients are nearest to the given ones in the mean over the domain: one
//! Poisson problem with the known boundary values. Equal to breadth-first integration where the
//! gradients are integrable, and free of its dependence on paths where they are not quite yet.
//! \param problem  mesh and boundary values
//! \param gradients  a vector per cell and control point, 1 / units of the mesh
//! \return n x V
//! \throws SolverError if the Poisson problem cannot be solved
template <class Scalar, int Dim>
WeightMatrix integrate_least_squares(const LbcProblem<Dim>& problem,
                                     const CellFieldView<Scalar, Dim>& gradients);

}  // namespace flbc

// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Recovers weights from gradients.
#pragma once

#include "flbc/lbc_problem.h"

namespace flbc {

//! Recovery by breadth-first integration (section 4.2.2 of the paper). A breadth-first search from
//! the boundary divides the vertices into levels. The weights of a level follow from the previous
//! level in parallel: w(v) = w(v') + g (v - v'). If several edges lead to a vertex, or several
//! cells share an edge, their values are averaged in a fixed order.
//! \param problem  mesh and boundary values
//! \param gradients  one vector per cell and control point, in 1 / units of the mesh
//! \return n x V
//! \throws InputError if the gradients are not of the control points of the problem
template <class Scalar, int Dim>
WeightMatrix integrate_breadth_first(const LbcProblem<Dim>& problem,
                                     const CellFieldView<Scalar, Dim>& gradients);

//! Recovery by least squares: finds the weights whose gradients are nearest to the given ones, by
//! one Poisson problem with the known boundary values. The result equals breadth-first integration
//! if the gradients are integrable. Otherwise, unlike breadth-first integration, it does not depend
//! on paths.
//! \param problem  mesh and boundary values
//! \param gradients  one vector per cell and control point, in 1 / units of the mesh
//! \return n x V
//! \throws InputError as above; SolverError if the Poisson problem cannot be solved
template <class Scalar, int Dim>
WeightMatrix integrate_least_squares(const LbcProblem<Dim>& problem,
                                     const CellFieldView<Scalar, Dim>& gradients);

}  // namespace flbc

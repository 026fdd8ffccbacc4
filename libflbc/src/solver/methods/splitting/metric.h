// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! The metric of the splitting, and its linear system.
#pragma once

#include "flbc/lbc_problem.h"
#include "linear/row_matrix.h"

namespace flbc::splitting {

//! Weights of the quadratic terms of the augmented Lagrangian, relative to the penalty. They do not
//! change the solution, but the rate of convergence.
struct Metric {
  Eigen::VectorXd cell;    //!< m_s > 0 of |z_s - grad w|^2, F
  Eigen::VectorXd vertex;  //!< k_v > 0 of |u_v - w_v|^2, V; empty: w may be negative
};

//! The metric of the continuous problem: the weight of a cell is its measure. The number of
//! iterations then depends little on the mesh.
template <int Dim>
Metric measure_metric(const LbcProblem<Dim>& problem, bool non_negative);

//! The metric of the constraint A z = A grad w of problem (2): the weight of a cell is its squared
//! measure.
//! \param vertex_weight  of u = w at every vertex; 0: w may be negative
template <int Dim>
Metric squared_measure_metric(const LbcProblem<Dim>& problem, double vertex_weight);

//! sum m grad^T grad + k over the interior vertices, ascending.
template <int Dim>
RowMatrix system_matrix(const LbcProblem<Dim>& problem, const Metric& metric);

}  // namespace flbc::splitting

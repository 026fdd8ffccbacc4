// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! The metric of the splitting, its linear system, and the constraints of its rows.
#pragma once

#include <limits>
#include <vector>

#include "base/aligned_array.h"
#include "flbc/lbc_problem.h"
#include "linear/row_matrix.h"
#include "solver/methods/splitting/column_slices.h"

namespace flbc::splitting {

//! Weights of the quadratic terms of the augmented Lagrangian, relative to the penalty. They do not
//! change the solution but decide how soon it is reached.
struct Metric {
  Eigen::VectorXd cell;    //!< m_s > 0 of |z_s - grad w|^2, F
  Eigen::VectorXd vertex;  //!< k_v > 0 of |u_v - w_v|^2, V; empty: w may be negative
};

//! The metric of the continuous problem, so that the number of iterations depends on the mesh
//! little: cells weigh what they measure.
template <int Dim>
Metric measure_metric(const LbcProblem<Dim>& problem, bool non_negative);

//! The metric of the constraint A z = A grad w of problem (2): cells weigh their squared measure.
//! \param vertex_weight  of u = w at every vertex; 0: w may be negative
template <int Dim>
Metric squared_measure_metric(const LbcProblem<Dim>& problem, double vertex_weight);

//! sum m grad^T grad + k over the interior vertices, ascending.
template <int Dim>
RowMatrix system_matrix(const LbcProblem<Dim>& problem, const Metric& metric);

//! The constraints { sum w = 1, sum w c = x } of every row.
template <class Scalar, int Dim>
struct RowConstraints {
  AlignedArray<Scalar> basis;  //!< (Dim + 1): orthonormal basis Q of [1; c]
  std::vector<Scalar> target;  //!< m x (Dim + 1): Q^T w of every row that is feasible
};

//! \param vertices  the vertex of each row \param stride  numbers per row
template <class Scalar, int Dim>
RowConstraints<Scalar, Dim> row_constraints(const LbcProblem<Dim>& problem,
                                            const std::vector<Index>& vertices, std::size_t stride);

}  // namespace flbc::splitting

// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Constant data of the splitting on the weights, as the inner loops want it.
#pragma once

#include <vector>

#include <Eigen/SparseCore>

#include "base/aligned_array.h"
#include "flbc/lbc_problem.h"

namespace flbc::splitting {

//! Weights of the quadratic terms of the augmented Lagrangian, relative to the penalty. They do not
//! change the solution but decide how soon it is reached.
struct Metric {
  Eigen::VectorXd cell;    //!< m_s > 0 of |z_s - grad w|^2, F
  Eigen::VectorXd vertex;  //!< k_v > 0 of |u_v - w_v|^2, V; empty: w may be negative
};

//! sum m grad^T grad + k over the interior vertices, ascending; the lower triangle.
template <int Dim>
Eigen::SparseMatrix<double> system_matrix(const LbcProblem<Dim>& problem, const Metric& metric);

//! Arrays of splitting_kernel.h, with the shapes given there.
template <class Scalar, int Dim>
struct SplittingData {
  std::vector<Index> vertices;   // interior vertices in the factor's order
  std::vector<Index> cell_rows;  // per corner of a cell its row, boundary vertices share the last
  AlignedArray<Scalar> phi;
  AlignedArray<Scalar> basis;
  std::vector<Scalar> hat_gradients;
  std::vector<Scalar> cell_metric;
  std::vector<Scalar> vertex_metric;  // empty: w may be negative
  std::vector<Scalar> measures;
  std::vector<Scalar> radius_scale;
  std::vector<Scalar> row_target;

  //! Radii phi A / (rho m) for a penalty rho.
  void set_radius_scale(const Metric& metric, double penalty);
};

//! \param position  the row of every unknown in the linear solver's arrays
//! \param stride  numbers per row
//! \return all but the radii
template <class Scalar, int Dim>
SplittingData<Scalar, Dim> make_splitting_data(const LbcProblem<Dim>& problem, const Metric& metric,
                                               const std::vector<Index>& position,
                                               std::size_t stride);

}  // namespace flbc::splitting

// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Constant data of the splitting on the weights, as the inner loops want it.
#pragma once

#include <limits>
#include <vector>

#include "base/aligned_array.h"
#include "flbc/lbc_problem.h"
#include "linear/row_matrix.h"
#include "solver/splitting/column_slices.h"

namespace flbc::splitting {

//! Weights of the quadratic terms of the augmented Lagrangian, relative to the penalty. They do not
//! change the solution but decide how soon it is reached.
struct Metric {
  Eigen::VectorXd cell;    //!< m_s > 0 of |z_s - grad w|^2, F
  Eigen::VectorXd vertex;  //!< k_v > 0 of |u_v - w_v|^2, V; empty: w may be negative
  //! Of u, which is at least 0. Weights that are not negative and sum up to 1 need none.
  double largest_weight = std::numeric_limits<double>::infinity();
};

//! The metric of the continuous problem, so that the number of iterations depends on the mesh
//! little: cells weigh what they measure.
template <int Dim>
Metric measure_metric(const LbcProblem<Dim>& problem, bool non_negative);

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

//! Arrays of splitting_kernel.h, with the shapes given there.
template <class Scalar, int Dim>
struct SplittingData {
  std::vector<Index> vertices;   // interior vertices in the factor's order
  std::vector<Index> cell_rows;  // per corner of a cell its row, boundary vertices share the last
  AlignedArray<Scalar> phi;
  RowConstraints<Scalar, Dim> constraints;
  std::vector<Scalar> hat_gradients;
  std::vector<Scalar> cell_metric;
  std::vector<Scalar> vertex_metric;  // empty: w may be negative
  std::vector<Scalar> measures;
  std::vector<Scalar> radius_scale;

  //! Radii phi A / (rho m) for a penalty rho.
  void set_radius_scale(const Metric& metric, double penalty);
};

//! \param position  the row of every unknown in the linear solver's arrays
//! \param slices  of phi
//! \return all but the radii
template <class Scalar, int Dim>
SplittingData<Scalar, Dim> make_splitting_data(const LbcProblem<Dim>& problem, const Metric& metric,
                                               const std::vector<Index>& position,
                                               const ColumnSlices& slices);

}  // namespace flbc::splitting

// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! The constraints of the gradient ADMM, constant during the iteration.
#pragma once

#include <vector>

#include "flbc/lbc_problem.h"

namespace flbc::gradient {

//! A row per control point, and some columns per cell or facet. Rows are padded with zeros, so
//! vector instructions need no remainder.
template <class Scalar>
using Field = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;

//! F cells, E facets.
template <class Scalar, int Dim>
struct ConstraintData {
  Field<Scalar> radius;           //!< a column per cell: phi A / mu
  std::vector<Scalar> smoothing;  //!< of F cells: epsilon A / (mu + epsilon A)
  Eigen::Matrix<Scalar, Eigen::Dynamic, Dim + 1> basis;  //!< orthonormal basis Q of [1; c]
  Eigen::Matrix<Scalar, Dim + 1, Dim> target;            //!< Q^T g for every g that satisfies (8)
  //! Orthonormal bases of the tangent spaces of E facets.
  std::vector<Eigen::Matrix<Scalar, Dim, Dim - 1>> tangents;
  std::vector<Index> boundary_index;  //!< of E facets: number among those of the boundary, or -1
  Field<Scalar> boundary_slope;       //!< Dim - 1 columns per boundary facet: h of (9)
};

//! \param penalty  mu > 0
template <class Scalar, int Dim>
ConstraintData<Scalar, Dim> make_constraint_data(const LbcProblem<Dim>& problem, double penalty);

}  // namespace flbc::gradient

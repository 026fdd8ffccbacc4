// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! The constraints of the gradient ADMM, constant during the iteration, laid out for the inner
//! loops.
#pragma once

#include <cstddef>
#include <vector>

#include "base/aligned_array.h"
#include "flbc/lbc_problem.h"

namespace flbc::gradient {

//! Arrays of gradient_kernel.h, with the shapes given there.
template <class Scalar, int Dim>
struct ConstraintData {
  AlignedArray<Scalar> radius;
  std::vector<Scalar> smoothing;
  AlignedArray<Scalar> boundary_slope;
  AlignedArray<Scalar> basis;
  AlignedArray<Scalar> target;
  std::vector<Scalar> tangents;
  std::vector<Index> boundary_index;
};

//! \param penalty  mu > 0 \param stride  values per row
template <class Scalar, int Dim>
ConstraintData<Scalar, Dim> make_constraint_data(const LbcProblem<Dim>& problem, double penalty,
                                                 std::size_t stride);

}  // namespace flbc::gradient

// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Options and problems of solver tests.
#pragma once

#include "flbc/solver.h"
#include "support/sample_meshes.h"

namespace flbc::testing {

//! The problem of the papers, which make_problem() makes by default. Its optimum does not determine
//! the weights.
inline SolverOptions without_smoothness() {
  SolverOptions options;
  options.smoothness = 0;
  return options;
}

//! The problem of default options, whose optimum is unique.
template <int Dim>
LbcProblem<Dim> smooth_problem(const Sample<Dim>& sample) {
  return make_problem(sample.cage, sample.mesh, DistanceScheme::kSquare, *resolve({}).smoothness);
}

//! A fixed number of iterations in double precision, independent of the error.
inline SolverOptions many_iterations(int count, SolverOptions options = {}) {
  options.precision = Precision::kDouble;
  options.tolerance = 1e-100;
  options.max_iterations = count;
  return options;
}

}  // namespace flbc::testing

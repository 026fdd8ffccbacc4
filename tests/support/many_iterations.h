// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Options of a solve whose weights others are compared with.
#pragma once

#include "flbc/options.h"

namespace flbc::testing {

//! A fixed number of iterations in double precision, independent of the error.
inline SolverOptions many_iterations(int count) {
  SolverOptions options;
  options.precision = Precision::kDouble;
  options.tolerance = 1e-100;
  options.max_iterations = count;
  return options;
}

}  // namespace flbc::testing

// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! The methods that are compared.
#pragma once

#include <vector>

#include "flbc/options.h"

namespace flbc::bench {

struct NamedMethod {
  const char* name;
  Method method;
  double penalty;  //!< 0 = by method

  //! The method's defaults otherwise.
  SolverOptions options(int threads) const {
    SolverOptions options;
    options.method = method;
    options.penalty = penalty;
    options.threads = threads;
    return options;
  }
};

//! The slowest first: the 2014 solver as published and at its best, the paper's to the letter, the
//! improved gradient method, the splitting on the weights.
const std::vector<NamedMethod>& methods();

}  // namespace flbc::bench

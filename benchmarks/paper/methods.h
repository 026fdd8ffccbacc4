// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! The methods that are compared.
#pragma once

#include <vector>

#include "flbc/lbc_problem.h"
#include "flbc/options.h"
#include "flbc/published_penalty.h"

namespace flbc::bench {

struct NamedMethod {
  const char* name;
  Method method;
  double penalty;  //!< as published, 0 = by method

  //! The method's defaults otherwise.
  template <int Dim>
  SolverOptions options(const LbcProblem<Dim>& problem, int threads) const {
    SolverOptions options;
    options.method = method;
    if (penalty > 0) {
      options.penalty = published_penalty(problem.cage, problem.mesh, method, penalty);
    }
    options.threads = threads;
    return options;
  }
};

//! The slowest first: the 2014 solver with its published penalty and at its best, the paper's, the
//! over-relaxed gradient method, the splitting on the weights.
const std::vector<NamedMethod>& methods();

}  // namespace flbc::bench

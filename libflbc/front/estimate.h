// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! How long a solve may take, before it starts.
#pragma once

#include <string>

#include "flbc/options.h"

namespace flbc::app {

//! Rough: times measured on two cores (docs/results) are half of it to 2.6 times as long.
struct Estimate {
  double seconds = 0;
  double bytes = 0;
};

//! Of a solve by the default method, without meshing.
Estimate estimate_solve(int dim, Index control_points, Index vertices,
                        const SolverOptions& options);

//! "about 40 s and 3.8 GB".
std::string describe(const Estimate& estimate);

//! Whether to announce the time to users.
bool is_long(const Estimate& estimate);

}  // namespace flbc::app

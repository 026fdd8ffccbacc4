// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! The options of a solve with every choice made that does not depend on the problem.
#pragma once

#include "flbc/options.h"

namespace flbc::plan {

//! Options in which every field has a value, except for a penalty that is chosen from the mesh.
struct Settings : SolverOptions {
  //! Whether the gap alone ends a run, because the optimum does not determine the weights.
  bool ends_by_gap = false;
  //! Over-relaxation in (0, 2).
  double relaxation = 1;
};

//! \param options  valid
Settings settings_of(const SolverOptions& options);

}  // namespace flbc::plan

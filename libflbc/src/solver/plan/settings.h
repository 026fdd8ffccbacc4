// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! The options of a solve with every choice made that does not depend on the problem.
#pragma once

#include "flbc/options.h"

namespace flbc::plan {

//! The gap that ends a run.
struct GapTarget {
  double gap = 0;        //!< relative; 0 = none
  bool settles = false;  //!< whether it also waits until the weights hardly move (kSettled), unless
                         //!< the gap is very small (kSmallGap)
};

//! SolverOptions without automatic values. The fields have the meaning they have there.
struct Settings {
  Method method;
  DistanceScheme phi;
  double smoothness;
  Distances distances;
  Precision precision;
  NonNegative non_negative;
  LinearSolver linear_solver;
  CoarseToFine coarse_to_fine;
  CoarseLevels coarse_levels;
  double tolerance;
  GapTarget gap;
  ActiveSet active_set;
  int max_iterations;
  std::optional<double> penalty;
  double relaxation;
  bool certify;
  int threads;
};

//! \param options  valid
Settings settings_of(const SolverOptions& options);

}  // namespace flbc::plan

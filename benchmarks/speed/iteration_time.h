// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Time of one iteration, without anything before and after.
#pragma once

#include <algorithm>

#include "flbc/solver.h"
#include "paper/stopwatch.h"

namespace flbc::bench {

//! Seconds of an iteration, as the least of some runs of ten; measured between two looks at the
//! residuals, one of which is included.
template <int Dim>
double iteration_seconds(const LbcProblem<Dim>& problem, Method method, int threads) {
  constexpr int kIterations = 10;
  constexpr int kRuns = 12;
  SolverOptions options;
  options.method = method;
  options.threads = threads;
  options.tolerance = 1e-100;
  options.check_interval = kIterations;
  options.max_iterations = kIterations * (kRuns + 1);
  const Stopwatch watch;
  double best = 1e300;
  double before = 0;
  Observer observer;
  observer.progress = [&](const Progress& progress) {
    const double now = watch.seconds();
    if (progress.iteration > kIterations) best = std::min(best, now - before);
    before = now;
    return true;
  };
  solve(problem, options, {}, observer);
  return best / kIterations;
}

}  // namespace flbc::bench

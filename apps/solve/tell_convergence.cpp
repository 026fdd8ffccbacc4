// SPDX-License-Identifier: BSD-3-Clause
#include <filesystem>
#include <iostream>

#include "solve/cage_solver.h"

namespace flbc::app {

bool tell_convergence(const SolveReport& report, const SolveSettings& settings) {
  if (report.status == SolveStatus::kConverged) return true;
  std::cerr << "flbc: not converged within " << settings.options.max_iterations
            << " iterations; the result was written nevertheless (see --max-iterations, --tolerance and --gap)";
  std::error_code ignored;
  if (std::filesystem::exists(settings.checkpoint.file, ignored)) {
    std::cerr << "; with a larger --max-iterations the solve goes on from "
              << settings.checkpoint.file;
  }
  std::cerr << '\n';
  return false;
}

}  // namespace flbc::app

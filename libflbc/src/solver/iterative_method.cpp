// SPDX-License-Identifier: BSD-3-Clause
#include "solver/iterative_method.h"

#include <cmath>

#include "base/messages.h"
#include "flbc/errors.h"

namespace flbc {

void require_finite(bool finite, const SolverOptions& options, const SolveReport& report) {
  if (finite) return;
  throw SolverError("the computation broke down within " + std::to_string(report.iterations) +
                    " iterations: its numbers are not finite; with penalty " +
                    format_number(options.penalty) + " and relaxation " +
                    format_number(options.relaxation) + ", try the defaults or double precision");
}

bool finished(int iteration, const SolverOptions& options, SolveReport& report) {
  require_finite(std::isfinite(report.primal_residual) && std::isfinite(report.dual_residual),
                 options, report);
  report.status = SolveStatus::kConverged;
  if (report.primal_residual <= 1 && report.dual_residual <= 1) return true;
  report.status = SolveStatus::kIterationLimit;
  if (iteration >= options.max_iterations) return true;
  report.status = SolveStatus::kStopped;
  return options.progress &&
         !options.progress({iteration, report.primal_residual, report.dual_residual});
}

}  // namespace flbc

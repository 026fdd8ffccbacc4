// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/option_lines.h"

#include <sstream>

#include "flbc/names.h"

namespace flbc {

std::string option_lines(const SolverOptions& options) {
  // All members are named, so that a new one does not compile until it is decided whether weights
  // depend on it.
  [[maybe_unused]] const auto& [method, phi, distances, precision, recovery, non_negative,
                                linear_solver, coarse_to_fine, coarse_levels, tolerance, gap,
                                active_pairs, max_iterations, penalty, relaxation, check_interval, certify,
                                threads, progress, resume_from, stage_progress] = options;
  const auto& [coarsest, factor, looseness] = coarse_levels;
  std::ostringstream lines;
  lines << std::hexfloat  // all bits of a number
        << "method " << name_of(method) << '\n'
        << "phi " << name_of(phi) << '\n'
        << "distances " << name_of(distances) << '\n'
        << "precision " << name_of(precision) << '\n'
        << "recovery " << name_of(recovery) << '\n'
        << "non_negative " << name_of(non_negative) << '\n'
        << "linear_solver " << name_of(linear_solver) << '\n'
        << "coarse_to_fine " << name_of(coarse_to_fine) << '\n'
        << "coarse_levels " << coarsest << ' ' << factor << ' ' << looseness << '\n'
        << "tolerance " << tolerance << '\n'
        << "gap " << gap.value_or(0) << '\n'
        << "active_pairs " << name_of(active_pairs) << '\n'
        << "penalty " << penalty << '\n'
        << "relaxation " << relaxation << '\n'
        << "check_interval " << check_interval << '\n'
        << "certify " << certify << '\n';
  return lines.str();
}

}  // namespace flbc

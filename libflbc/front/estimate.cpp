// SPDX-License-Identifier: BSD-3-Clause
#include "front/estimate.h"

#include <cmath>
#include <sstream>

#include "flbc/solver.h"

namespace flbc::app {
namespace {

// Least squares of logarithms on docs/results: seconds are 0.4 to 2 times, and bytes 0.7 to 1.4
// times those of models.csv, speed.csv, and many.csv.
constexpr double kSecondsPerPair2D = 4.5e-7, kSecondsPerPair3D = 3.4e-7;
constexpr double kBytesPerPair2D = 83, kBytesPerPair3D = 105;
// On an active set, of the pairs in it.
constexpr double kSecondsPerActivePair = 1.6e-6, kBytesPerActivePair = 225;
constexpr double kSecondsPerDistance = 2.6e-8, kBytesPerDistance = 8;  // of all pairs
constexpr double kBase = 25e6;  // bytes of the program itself

// Share of the pairs in an active set: 16% for 110 control points, 6% for 1,000.
double active_share(double control_points) {
  return 0.16 * std::pow(110 / control_points, 0.43);
}

// "0.25", "1.3", "120".
std::string rounded(double value) {
  const double unit = std::pow(10, std::floor(std::log10(value)) - 1);
  std::ostringstream text;
  text << std::round(value / unit) * unit;
  return text.str();
}

}  // namespace

Estimate estimate_solve(int dim, Index control_points, Index vertices,
                        const SolverOptions& options) {
  const double pairs = static_cast<double>(control_points) * vertices;
  const Estimate all = {(dim == 2 ? kSecondsPerPair2D : kSecondsPerPair3D) * pairs,
                        kBase + (dim == 2 ? kBytesPerPair2D : kBytesPerPair3D) * pairs};
  constexpr double kActiveDensity = 0.3;  // above which the solver takes all pairs
  const double share = active_share(control_points);
  if (share > kActiveDensity || !tries_active_set(dim, control_points, vertices, options)) {
    return all;
  }
  const double active = share * pairs;
  return {kSecondsPerActivePair * active + kSecondsPerDistance * pairs,
          kBase + kBytesPerActivePair * active + kBytesPerDistance * pairs};
}

std::string describe(const Estimate& estimate) {
  constexpr double kMinute = 60, kGigabyte = 1e9, kMegabyte = 1e6;
  const bool is_slow = estimate.seconds > 2 * kMinute;
  const bool is_large = estimate.bytes >= kGigabyte;
  return "about " + rounded(is_slow ? estimate.seconds / kMinute : estimate.seconds) +
         (is_slow ? " min" : " s") + " and " +
         rounded(estimate.bytes / (is_large ? kGigabyte : kMegabyte)) + (is_large ? " GB" : " MB");
}

bool is_long(const Estimate& estimate) {
  constexpr double kSeconds = 10, kBytes = 1e9;
  return estimate.seconds > kSeconds || estimate.bytes > kBytes;
}

}  // namespace flbc::app

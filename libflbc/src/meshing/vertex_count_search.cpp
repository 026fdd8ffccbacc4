// SPDX-License-Identifier: BSD-3-Clause
#include "meshing/vertex_count_search.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/instantiate.h"

namespace flbc {

namespace {

// Width of a bracket in the logarithm of the bound: 1%.
constexpr double kNarrow = 0.01;
// Largest change of the bound in a step: counts that level off must not end in a huge mesh.
const double kLargestStep = std::log(4.0);

struct Sample {
  double log_bound;
  double log_count;
};

}  // namespace

template <int Dim>
DomainMesh<Dim> search_vertex_count(const VertexCountGoal<Dim>& goal, DomainMesh<Dim> best,
                                    double first_bound, double exponent,
                                    const std::function<DomainMesh<Dim>(double)>& make_mesh,
                                    int max_runs) {
  const double wanted = std::log(double(goal.vertices));
  double too_fine = -std::numeric_limits<double>::infinity();  // bracket of the logarithmic bound
  double too_coarse = std::numeric_limits<double>::infinity();
  double slope = -exponent;
  Sample last{0, 0};
  double least_error = goal.error(goal.count(best));

  double log_bound = std::log(first_bound);
  for (int run = 0; run < max_runs; ++run) {
    if (least_error <= goal.good_enough) break;
    DomainMesh<Dim> mesh = make_mesh(std::exp(log_bound));
    const double count = goal.count(mesh);  // of edges, too: it takes a while
    const Sample sample{log_bound, std::log(count)};
    if (goal.error(count) < least_error) {
      least_error = goal.error(count);
      best = std::move(mesh);
    }

    (sample.log_count > wanted ? too_fine : too_coarse) = log_bound;
    if (run > 0 && sample.log_bound != last.log_bound) {
      // Counts are noisy and level off toward the coarsest mesh, so a secant far from the known
      // rate would overshoot.
      const double secant =
          (sample.log_count - last.log_count) / (sample.log_bound - last.log_bound);
      slope = std::clamp(secant, -2 * exponent, -exponent / 8);
    }
    last = sample;
    const double step = (wanted - sample.log_count) / slope;
    log_bound = sample.log_bound + std::clamp(step, -kLargestStep, kLargestStep);
    const bool has_bracket = std::isfinite(too_fine) && std::isfinite(too_coarse);
    if (has_bracket && too_coarse - too_fine < kNarrow) break;  // the count jumps within
    if (has_bracket && !(too_fine < log_bound && log_bound < too_coarse)) {
      log_bound = (too_fine + too_coarse) / 2;
    }
  }
  return best;
}

FLBC_INSTANTIATE_FUNCTION(search_vertex_count)

}  // namespace flbc

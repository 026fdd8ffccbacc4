// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/coordinates.h"

#include <limits>

#include "base/instantiate.h"
#include "base/parallel.h"
#include "base/stage_progress.h"
#include "base/stopwatch.h"
#include "flbc/errors.h"
#include "flbc/harmonic.h"
#include "flbc/non_negative.h"
#include "problem/problem_geometry.h"
#include "solver/api/solve_parts.h"
#include "solver/run/reporter.h"

namespace flbc {
namespace {

template <int Dim>
SparseWeights weights_of(const LbcProblem<Dim>& problem, Coordinates coordinates) {
  const WeightMatrix weights =
      coordinates == Coordinates::kHarmonic ? harmonic_coordinates(problem)
      : coordinates == Coordinates::kBiharmonic
          ? bounded_biharmonic_weights(problem)
          : pointwise_coordinates(problem.cage, problem.mesh.points, coordinates);
  if (!weights.allFinite()) throw SolverError("the coordinates are not finite");
  return weights;
}

}  // namespace

void validate(Coordinates coordinates, const CoordinatesOptions& options) {
  SolverOptions like;
  like.method = Method::kGradient;  // which has no constraint either
  like.non_negative = options.non_negative;
  like.threads = options.threads;
  validate(like);
  if (coordinates == Coordinates::kGreen) {
    throw OptionError(
        "Green coordinates also have weights for normals of facets, which compute_coordinates() "
        "does not return; use green_coordinates() in C++");
  }
  if (coordinates == Coordinates::kBiharmonic && options.non_negative == NonNegative::kProject) {
    throw OptionError(
        "bounded biharmonic weights are not negative, so non_negative does not apply");
  }
}

template <int Dim>
Solution compute_coordinates(const Cage<Dim>& cage, const DomainMesh<Dim>& mesh,
                             Coordinates coordinates, const CoordinatesOptions& options,
                             const Observer& observer) {
  validate(coordinates, options);
  const auto compute_connected = [&](const Cage<Dim>& part, const DomainMesh<Dim>& domain,
                                     const Observer& own, const std::vector<Index>&, bool) {
    const ThreadScope threads(threads_for(options.threads, part.size(), domain.num_vertices()));
    Stopwatch watch;
    Solution solution;
    auto& [weights, report] = solution;
    report.control_points = part.size();
    report.vertices = domain.num_vertices();
    report.cells = domain.num_cells();
    report.objective = std::numeric_limits<double>::quiet_NaN();
    const auto problem = make_geometry(part, domain);
    report.seconds.setup = watch.lap();
    weights = weights_of(problem, coordinates);
    report.seconds.solve = watch.lap();
    if (options.non_negative == NonNegative::kProject) {
      const StageScope scope(Reporter(own).stage(Stage::kNonNegative));
      weights = project_non_negative<Dim>(problem.cage.points, problem.mesh.points, weights,
                                          problem.boundary.interior_vertices());
    }
    report.seconds.recover = watch.lap();
    report.quality = measure_quality(problem.cage.points, problem.mesh.points, weights);
    return solution;
  };
  return solve_parts<Dim>(cage, mesh, observer, compute_connected);
}

FLBC_INSTANTIATE_FUNCTION(compute_coordinates)

}  // namespace flbc

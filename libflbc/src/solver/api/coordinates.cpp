// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/coordinates.h"

#include <limits>
#include <numeric>
#include <vector>

#include "base/parallel.h"
#include "base/stage_progress.h"
#include "base/stopwatch.h"
#include "flbc/biharmonic.h"
#include "flbc/blended.h"
#include "flbc/cage_facts.h"
#include "flbc/errors.h"
#include "flbc/harmonic.h"
#include "flbc/maximum_entropy.h"
#include "flbc/maximum_likelihood.h"
#include "flbc/mean_value.h"
#include "flbc/non_negative.h"
#include "problem/problem_geometry.h"
#include "solver/api/solve_parts.h"

namespace flbc {
namespace {

template <int Dim>
WeightMatrix in_part(const Cage<Dim>& cage, const PointList<Dim>& points, Coordinates coordinates) {
  switch (coordinates) {
    case Coordinates::kMeanValue:
      return mean_value_coordinates(cage, points);
    case Coordinates::kMaxEntropy:
      return maximum_entropy_coordinates(cage, points);
    case Coordinates::kMaxLikelihood:
      return maximum_likelihood_coordinates(cage, points);
    case Coordinates::kBlended:
      if constexpr (Dim == 2) return blended_coordinates(cage, points);
      throw OptionError("method blended is for cages in 2D; choose another method");
    default:
      throw OptionError("these coordinates need a domain mesh; use compute_coordinates()");
  }
}

// Numbers of the points by the part with the nearest place of the cage. Parts may be nested, but
// only in holes, so that the nearest place belongs to the part around a point.
template <int Dim>
std::vector<std::vector<Index>> points_of_parts(const Cage<Dim>& cage,
                                                const std::vector<CagePart<Dim>>& parts,
                                                const PointList<Dim>& points) {
  std::vector<std::size_t> part_of(static_cast<std::size_t>(cage.size()));
  for (std::size_t k = 0; k < parts.size(); ++k) {
    for (const Index i : parts[k].control_points) part_of[i] = k;
  }
  std::vector<Index> all(static_cast<std::size_t>(points.cols()));
  std::iota(all.begin(), all.end(), 0);
  std::vector<std::vector<Index>> numbers(parts.size());
  for (const auto& place : nearest_on_cage(cage, points, all)) {
    numbers[part_of[cage.facets(0, place.facet)]].push_back(place.point);
  }
  return numbers;
}

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

bool is_pointwise(Coordinates coordinates) {
  return coordinates == Coordinates::kMeanValue || coordinates == Coordinates::kMaxEntropy ||
         coordinates == Coordinates::kMaxLikelihood || coordinates == Coordinates::kBlended;
}

template <int Dim>
WeightMatrix pointwise_coordinates(const Cage<Dim>& cage, const PointList<Dim>& points,
                                   Coordinates coordinates) {
  const auto parts = cage_parts(cage);
  if (parts.size() == 1) return in_part(cage, points, coordinates);
  const auto numbers = points_of_parts(cage, parts, points);
  WeightMatrix weights = WeightMatrix::Zero(cage.size(), points.cols());
  for (std::size_t k = 0; k < parts.size(); ++k) {
    const PointList<Dim> some = points(Eigen::all, numbers[k]);
    weights(parts[k].control_points, numbers[k]) = in_part(parts[k].cage, some, coordinates);
  }
  return weights;
}

template <int Dim>
SparseWeights pointwise_coordinates(const Cage<Dim>& cage, const Placement<Dim>& placement,
                                    Coordinates coordinates, const CoordinatesOptions& options) {
  validate(coordinates, options);
  const ThreadScope threads(options.threads);
  PointList<Dim> points = placement.points;
  std::vector<bool> is_beside(static_cast<std::size_t>(points.cols()), false);
  for (const auto* beside : {&placement.on_cage, &placement.outside}) {
    for (const auto& [point, facet, corners, distance] : *beside) {
      is_beside[point] = true;
      points.col(point) = cage.points.col(cage.facets(0, facet));  // not used
    }
  }
  auto weights = pointwise_coordinates(cage, points, coordinates);
  if (options.non_negative == NonNegative::kProject) {
    std::vector<Index> inside;
    for (Index p = 0; p < points.cols(); ++p) {
      if (!is_beside[p]) inside.push_back(p);
    }
    return weights_at(cage, project_non_negative<Dim>(cage.points, points, weights, inside),
                      placement);
  }
  return weights_at(cage, weights, placement);
}

template <int Dim>
Solution compute_coordinates(const Cage<Dim>& cage, const DomainMesh<Dim>& mesh,
                             Coordinates coordinates, const CoordinatesOptions& options,
                             const Observer& observer) {
  validate(coordinates, options);
  const auto compute_connected = [&](const Cage<Dim>& part, const DomainMesh<Dim>& domain,
                                     const Reporter& reporter, bool) {
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
      const StageScope scope(reporter.stage(Stage::kNonNegative));
      weights = project_non_negative<Dim>(problem.cage.points, problem.mesh.points, weights,
                                          problem.boundary.interior_vertices());
    }
    report.seconds.recover = watch.lap();
    report.quality = measure_quality(problem.cage.points, problem.mesh.points, weights);
    return solution;
  };
  return solve_parts<Dim>(cage, mesh, Reporter(observer), compute_connected);
}

#define FLBC_INSTANTIATE(Dim)                                                                  \
  template WeightMatrix pointwise_coordinates(const Cage<Dim>&, const PointList<Dim>&,         \
                                              Coordinates);                                    \
  template SparseWeights pointwise_coordinates(const Cage<Dim>&, const Placement<Dim>&,        \
                                               Coordinates, const CoordinatesOptions&);        \
  template Solution compute_coordinates(const Cage<Dim>&, const DomainMesh<Dim>&, Coordinates, \
                                        const CoordinatesOptions&, const Observer&);
FLBC_INSTANTIATE(2)
FLBC_INSTANTIATE(3)
#undef FLBC_INSTANTIATE

}  // namespace flbc

// SPDX-License-Identifier: BSD-3-Clause
// Distances from the coarse mesh of a refined one: when they are taken, and what they change.
#include "flbc/coordinates.h"
#include "support/refined_sample.h"
#include "support/solver_options.h"

namespace flbc::testing {
namespace {

template <int Dim>
Sample<Dim> corner(Index resolution) {
  return refined_sample<Dim>(Shape::kCorner, resolution);
}

template <int Dim>
Solution solve_with(const Sample<Dim>& sample, Distances distances, std::optional<double> tolerance,
                    Method method = Method::kWeights) {
  SolverOptions options{method};
  options.distances = distances;
  options.tolerance = tolerance;
  if (method != Method::kWeights) options.max_iterations = 20;
  return solve(sample.cage, sample.mesh, options);
}

TEST_IN_2D_AND_3D(SetUpTest, InterpolatedDistancesChangeWeightsLittleAndAreReported) {
  const auto sample = corner<Dim>(Dim == 2 ? 12 : 4);
  const auto exact = solve_with(sample, Distances::kExact, 1e-8);
  EXPECT_EQ(exact.report.distances.source, Distances::kExact);
  EXPECT_EQ(exact.report.distances.vertices, 0);
  const auto other = solve_with(sample, Distances::kInterpolated, 1e-8);
  EXPECT_EQ(other.report.distances.source, Distances::kInterpolated);
  EXPECT_EQ(other.report.distances.vertices, coarse_mesh(sample.mesh)->mesh.num_vertices());
  EXPECT_GT(other.report.distances.phi_error, 0);
  EXPECT_LT(other.report.distances.phi_error, 0.02);
  const double change =
      mean_squared_difference(sample.mesh, other.weights.dense(), exact.weights.dense());
  EXPECT_GT(change, 0);
  EXPECT_LT(change, 3e-6);
  const auto judgement = expect_coordinates(sample.cage, sample.mesh, other.weights.dense(), 1e-12);
  EXPECT_GE(judgement.min_weight, 0);
}

TEST_IN_2D_AND_3D(SetUpTest, LeftToItselfItKeepsTheTolerance) {
  const auto sample = corner<Dim>(2);
  const auto exact = solve_with(sample, Distances::kExact, 1e-9);
  for (const double tolerance : {1e-4, 1e-6, 1e-8}) {
    const auto weights = solve_with(sample, Distances::kAuto, tolerance).weights.dense();
    EXPECT_LT(mean_squared_difference(sample.mesh, weights, exact.weights.dense()), 3 * tolerance);
  }
}

TEST_IN_2D_AND_3D(SetUpTest, OtherMethodsAreExactUnlessAsked) {
  const auto source = [](Distances distances) {
    return solve_with(corner<Dim>(2), distances, {}, Method::kLbc2014).report.distances.source;
  };
  EXPECT_EQ(source(Distances::kAuto), Distances::kExact);
  EXPECT_EQ(source(Distances::kInterpolated), Distances::kInterpolated);
}

TEST_IN_2D_AND_3D(SetUpTest, OtherCoordinatesNeedNone) {
  const auto sample = corner<Dim>(2);
  for (const auto coordinates : {Coordinates::kHarmonic, Coordinates::kMeanValue}) {
    const auto solution = compute_coordinates(sample.cage, sample.mesh, coordinates);
    EXPECT_TRUE(std::isnan(solution.report.objective));
    EXPECT_GT(solution.report.seconds.setup, 0);
    auto without = smooth_problem(sample);
    without.phi = {};
    EXPECT_THROW(solve(without), InputError);
  }
}

TEST_IN_2D_AND_3D(SetUpTest, OnAMeshThatIsNotRefinedTheyAreExact) {
  auto sample = corner<Dim>(2);
  sample.mesh = in_other_order(sample.mesh);
  EXPECT_EQ(solve_with(sample, Distances::kAuto, 1e-4).report.distances.source, Distances::kExact);
  SolverOptions options;
  options.distances = Distances::kInterpolated;
  EXPECT_THROW(solve(sample.cage, sample.mesh, options), OptionError);
  EXPECT_THROW(Solver<Dim>(sample.cage, sample.mesh, options), OptionError);
}

}  // namespace
}  // namespace flbc::testing

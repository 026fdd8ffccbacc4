// SPDX-License-Identifier: BSD-3-Clause
// Distances from a coarser mesh: when they are taken, and what they change.
#include "flbc/coordinates.h"
#include "support/coarse_sample_mesher.h"
#include "support/solver_options.h"
#include "support/test.h"

namespace flbc::testing {
namespace {

template <int Dim>
Sample<Dim> corner() {
  return make_sample<Dim>(Shape::kCorner, Dim == 2 ? 24 : 8, 0.2);
}

template <int Dim>
Solution solve_with(Distances distances, std::optional<double> tolerance, Index resolution,
                    Method method = Method::kWeights) {
  const auto sample = corner<Dim>();
  SolverOptions options;
  options.method = method;
  options.distances = distances;
  options.tolerance = tolerance;
  if (method != Method::kWeights) options.max_iterations = 20;
  options.coarse_to_fine = CoarseToFine::kOff;
  return solve(sample.cage, sample.mesh, options, coarse_sample_mesher<Dim>(resolution));
}

TEST_IN_2D_AND_3D(SetUpTest, InterpolatedDistancesChangeWeightsLittleAndAreReported) {
  const auto sample = corner<Dim>();
  const auto exact = solve_with<Dim>(Distances::kExact, 1e-8, 6);
  EXPECT_EQ(exact.report.distances.source, Distances::kExact);
  EXPECT_EQ(exact.report.distances.vertices, 0);
  const auto other = solve_with<Dim>(Distances::kInterpolated, 1e-8, 6);
  EXPECT_EQ(other.report.distances.source, Distances::kInterpolated);
  EXPECT_EQ(other.report.distances.vertices,
            make_sample<Dim>(Shape::kCorner, 6, 0.2).mesh.num_vertices());
  EXPECT_GT(other.report.distances.phi_error, 0);
  EXPECT_LT(other.report.distances.phi_error, 0.02);
  const double change =
      mean_squared_difference(sample.mesh, other.weights.dense(), exact.weights.dense());
  EXPECT_GT(change, 0);
  EXPECT_LT(change, 3e-6);
  const auto judgement = judge(sample.cage, sample.mesh, other.weights.dense());
  EXPECT_LT(judgement.partition_error, 1e-12);
  EXPECT_LT(judgement.reproduction_error, 1e-12);
  EXPECT_GE(judgement.min_weight, 0);
}

TEST_IN_2D_AND_3D(SetUpTest, LeftToItselfItKeepsTheTolerance) {
  const auto sample = corner<Dim>();
  const auto exact = solve_with<Dim>(Distances::kExact, 1e-9, 2);
  for (const double tolerance : {1e-4, 1e-6, 1e-8}) {
    const auto weights = solve_with<Dim>(Distances::kAuto, tolerance, 2).weights.dense();
    EXPECT_LT(mean_squared_difference(sample.mesh, weights, exact.weights.dense()), 2 * tolerance);
  }
}

TEST_IN_2D_AND_3D(SetUpTest, OtherMethodsAreExactUnlessAsked) {
  const auto source = [](Distances distances) {
    return solve_with<Dim>(distances, {}, 4, Method::kLbc2014).report.distances.source;
  };
  EXPECT_EQ(source(Distances::kAuto), Distances::kExact);
  EXPECT_EQ(source(Distances::kInterpolated), Distances::kInterpolated);
}

TEST_IN_2D_AND_3D(SetUpTest, OtherCoordinatesNeedNone) {
  const auto sample = corner<Dim>();
  for (const auto coordinates : {Coordinates::kHarmonic, Coordinates::kMeanValue}) {
    const auto solution = compute_coordinates(sample.cage, sample.mesh, coordinates);
    EXPECT_TRUE(std::isnan(solution.report.objective));
    EXPECT_GT(solution.report.seconds.setup, 0);
    auto without = smooth_problem(sample);
    without.phi = {};
    EXPECT_THROW(solve(without), InputError);
  }
}

TEST_IN_2D_AND_3D(SetUpTest, WithoutAMeshTheyAreExactAndWithoutAMesherRefused) {
  const auto sample = corner<Dim>();
  SolverOptions options;
  options.tolerance = 1e-4;
  options.distances = Distances::kInterpolated;
  EXPECT_THROW(solve(sample.cage, sample.mesh, options), OptionError);
  EXPECT_THROW(Solver<Dim>(sample.cage, sample.mesh, options), OptionError);
  const CoarseMesher<Dim> fails = [](const Cage<Dim>&, Index) -> DomainMesh<Dim> {
    throw InputError("too few");
  };
  const auto solution = solve(sample.cage, sample.mesh, options, fails);
  EXPECT_EQ(solution.report.distances.source, Distances::kExact);
  options.distances = Distances::kExact;
  EXPECT_TRUE(solve(sample.cage, sample.mesh, options).weights.dense() == solution.weights.dense());
}

}  // namespace
}  // namespace flbc::testing

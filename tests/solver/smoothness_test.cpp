// SPDX-License-Identifier: BSD-3-Clause
// The quadratic term of SolverOptions::smoothness: the optimum is unique, so that weights
// themselves are compared.
#include "flbc/certificate.h"
#include "flbc/harmonic.h"
#include "support/refined_sample.h"
#include "support/solver_options.h"

namespace flbc::testing {
namespace {

constexpr double kProvedGap = 1e-5;
constexpr Shape kShapes[] = {Shape::kBox, Shape::kCorner, Shape::kStar};

template <int Dim>
Sample<Dim> tiny_sample(Shape shape) {
  return make_sample<Dim>(shape, Dim == 2 ? 4 : shape == Shape::kCorner ? 2 : 3, 0.2);
}

SolverOptions accurate(double smoothness, int iterations = 3000) {
  SolverOptions options;
  options.smoothness = smoothness;
  return many_iterations(iterations, options);
}

template <int Dim>
double largest_difference(const WeightMatrix& a, const WeightMatrix& b) {
  return (a - b).cwiseAbs().maxCoeff();
}

// A bound that has nothing to do with the iteration is tight, and the objective is that of the
// problem in the units of the mesh.
TEST_IN_2D_AND_3D(SmoothnessTest, WeightsAreProvedOptimal) {
  for (const Shape shape : kShapes) {
    const auto sample = tiny_sample<Dim>(shape);
    for (const double smoothness : {0.003, 0.03}) {
      SCOPED_TRACE(sample.name + ", smoothness " + std::to_string(smoothness));
      const auto problem =
          make_problem(sample.cage, sample.mesh, DistanceScheme::kSquare, smoothness);
      auto options = accurate(smoothness);
      options.certify = true;
      const auto [weights, report] = solve(problem, options);
      const double own = testing::objective(problem.mesh, weights.dense(), problem.phi.dense(),
                                            problem.smoothness);
      EXPECT_NEAR(report.objective * std::pow(problem.scale, Dim - 1), own, 1e-9 * own);
      EXPECT_LT(report.certificate.relative_gap, kProvedGap);
    }
  }
}

// In every precision, on the active set, and after a multilevel start.
TEST_IN_2D_AND_3D(SmoothnessTest, AllVariantsFindOneOptimum) {
  const auto sample = refined_sample<Dim>(Shape::kCorner, Dim == 2 ? 6 : 3);
  const auto optimum = solve(sample.cage, sample.mesh, many_iterations(1000)).weights.dense();
  const auto expect_optimal = [&](const char* what, auto change) {
    SolverOptions options;
    change(options);
    const auto [weights, report] = solve(sample.cage, sample.mesh, options);
    EXPECT_EQ(report.status, SolveStatus::kConverged) << what;
    EXPECT_LT(mean_squared_difference(sample.mesh, weights.dense(), optimum),
              3 * *resolve(options).tolerance)
        << what;
  };
  expect_optimal("double precision", [](auto& o) { o.precision = Precision::kDouble; });
  expect_optimal("active set", [](auto& o) { o.active_set = ActiveSet::kOn; });
  expect_optimal("exact distances", [](auto& o) { o.distances = Distances::kExact; });
  expect_optimal("default options", [](auto&) {});
}

TEST_IN_2D_AND_3D(SmoothnessTest, BoundsHoldForAnyFlux) {
  const auto sample = tiny_sample<Dim>(Shape::kCorner);
  const double smoothness = 0.01;
  const auto problem = make_problem(sample.cage, sample.mesh, DistanceScheme::kSquare, smoothness);
  const auto optimum = solve(problem, accurate(smoothness));
  const double least = objective(problem.mesh, problem.phi, optimum.weights.dense(), smoothness);
  const Index n = problem.num_control_points();
  const Index rows = problem.mesh.num_cells() * Dim;
  // Fluxes like gradients of harmonic coordinates, too short, right in size, and far too long.
  const auto harmonic = harmonic_coordinates(problem);
  double best = 0;
  for (const double factor : {0.0, 0.01, 0.1, 1.0, 1e3, 1e160}) {
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> flux(rows, n);
    for (Index s = 0; s < problem.mesh.num_cells(); ++s) {
      const auto corners = cell_corners(problem.mesh, s);
      flux.middleRows(Dim * s, Dim) =
          factor * simplex_measure<Dim>(corners) *
          linear_gradients<Dim>(corners, columns_of(harmonic, problem.mesh.cells.col(s)));
    }
    const CellFieldView<double, Dim> view{flux.data(), static_cast<std::size_t>(n), n};
    const double bound = lower_bound(problem, view, optimum.weights.dense());
    EXPECT_GE(bound, 0) << factor;
    EXPECT_LE(bound, least * (1 + 1e-9)) << factor;
    best = std::max(best, bound);
  }
  EXPECT_GT(best, 0.1 * least);
}

// Far toward either end.
TEST_IN_2D_AND_3D(SmoothnessTest, LeadsFromTotalVariationToHarmonicCoordinates) {
  const auto sample = tiny_sample<Dim>(Shape::kCorner);
  const auto problem = make_problem(sample.cage, sample.mesh, DistanceScheme::kSquare, 0);
  const auto with = [&](double smoothness, NonNegative non_negative = NonNegative::kConstraint) {
    auto options = accurate(smoothness);
    options.non_negative = non_negative;
    return solve(sample.cage, sample.mesh, options).weights.dense();
  };
  const auto variation = [&](const WeightMatrix& weights) {
    return objective(problem.mesh, problem.phi, weights);
  };
  const double least = variation(with(0));
  EXPECT_NEAR(variation(with(1e-5)), least, 1e-4 * least);
  EXPECT_GT(variation(with(0.1)), least * (1 + 1e-3));
  const auto harmonic = harmonic_coordinates(problem);
  const double far = largest_difference<Dim>(with(1, NonNegative::kOff), harmonic);
  EXPECT_GT(far, 1e-4);
  EXPECT_LT(largest_difference<Dim>(with(1000, NonNegative::kOff), harmonic), 0.05 * far);
}

}  // namespace
}  // namespace flbc::testing

// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/recovery.h"
#include "flbc/harmonic.h"
#include "support/cell_field.h"

namespace flbc::testing {
namespace {

template <class Scalar, int Dim>
Field<Scalar, Dim> gradients_of(const DomainMesh<Dim>& mesh, const WeightMatrix& weights) {
  Field<Scalar, Dim> field(mesh, static_cast<Index>(weights.rows()));
  field.fill([&](Index s, Index i) { return gradient_of(mesh, weights, s, i); });
  return field;
}

// Weights that obey every constraint, with something added inside that keeps sums and reproduction.
template <int Dim>
WeightMatrix feasible_weights(const LbcProblem<Dim>& problem) {
  auto weights = harmonic_coordinates(problem);
  const Eigen::MatrixXd constraints =
      (Eigen::MatrixXd(Dim + 1, problem.num_control_points())
           << Eigen::RowVectorXd::Ones(problem.num_control_points()),
       problem.cage.points)
          .finished();
  const Eigen::MatrixXd kernel = null_space(constraints);
  for (Index v = 0; v < problem.mesh.num_vertices(); ++v) {
    if (problem.boundary.boundary_index[v] >= 0) continue;
    for (Eigen::Index k = 0; k < kernel.cols(); ++k) {
      weights.col(v) += 0.1 * std::sin(1.0 + static_cast<double>(v * (k + 1))) * kernel.col(k);
    }
  }
  return weights;
}

TEST_IN_2D_AND_3D(RecoveryTest, IntegratingTheGradientsOfWeightsGivesTheWeights) {
  for (const auto& sample : samples<Dim>()) {
    SCOPED_TRACE(sample.name);
    const auto problem = make_problem(sample.cage, sample.mesh, DistanceScheme::kConstant, 0);
    const auto weights = feasible_weights(problem);
    const auto exact = gradients_of<double>(problem.mesh, weights);
    const auto rounded = gradients_of<float>(problem.mesh, weights);
    const auto difference = [&](const WeightMatrix& other) {
      return (other - weights).cwiseAbs().maxCoeff();
    };
    EXPECT_LT(difference(integrate_breadth_first(problem, exact.view)), 1e-11);
    EXPECT_LT(difference(integrate_least_squares(problem, exact.view)), 1e-11);
    EXPECT_LT(difference(integrate_breadth_first(problem, rounded.view)), 1e-4);
    EXPECT_LT(difference(integrate_least_squares(problem, rounded.view)), 1e-4);
  }
}

TEST_IN_2D_AND_3D(RecoveryTest, ConstraintsHoldToRoundingForGradientsThatAreNotIntegrable) {
  const auto sample = make_sample<Dim>(Shape::kRing, 4, 0.2);
  const auto problem = make_problem(sample.cage, sample.mesh, DistanceScheme::kConstant, 0);
  const auto weights = feasible_weights(problem);
  auto gradients = gradients_of<float>(problem.mesh, weights);
  for (std::size_t k = 0; k < gradients.numbers.size(); ++k) {
    gradients.numbers[k] *= 1 + 0.1f * std::sin(static_cast<float>(k));
  }
  const auto breadth_first = integrate_breadth_first(problem, gradients.view);
  for (const auto& recovered : {breadth_first, integrate_least_squares(problem, gradients.view)}) {
    expect_coordinates(problem.cage, problem.mesh, recovered);
  }
  const ThreadScope one_thread(1);
  EXPECT_TRUE(
      (integrate_breadth_first(problem, gradients.view).array() == breadth_first.array()).all());
}

TEST_IN_2D_AND_3D(RecoveryTest, GradientsOfOtherControlPointsAreRefused) {
  const auto sample = make_sample<Dim>(Shape::kBox, 2);
  const auto problem = make_problem(sample.cage, sample.mesh, DistanceScheme::kConstant, 0);
  const auto fewer = gradients_of<double>(problem.mesh, feasible_weights(problem).topRows(2));
  EXPECT_THROW(integrate_breadth_first(problem, fewer.view), InputError);
  EXPECT_THROW(integrate_least_squares(problem, fewer.view), InputError);
}

// Where no angle between facets of a cell is obtuse, a vertex is a mean of its neighbors.
TEST_IN_2D_AND_3D(RecoveryTest, HarmonicCoordinatesObeyTheMaximumPrinciple) {
  for (const Index subdivisions : {3, 4, 5}) {
    const auto sample = make_sample<Dim>(Shape::kBox, subdivisions);
    SCOPED_TRACE(sample.name);
    const auto problem = make_problem(sample.cage, sample.mesh, DistanceScheme::kConstant, 0);
    ASSERT_FALSE(problem.boundary.interior_vertices().empty());
    const auto judgement = judge(problem.cage, problem.mesh, harmonic_coordinates(problem), 1e-12);
    EXPECT_GE(judgement.min_weight, -1e-12);
    for (Index i = 0; i < sample.cage.size(); ++i) {
      EXPECT_EQ(judgement.local_minima[i], 0) << "control point " << i;
      EXPECT_EQ(judgement.local_maxima[i], 0) << "control point " << i;
    }
  }
}

}  // namespace
}  // namespace flbc::testing

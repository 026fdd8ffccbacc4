// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/recovery.h"
#include "base/aligned_array.h"
#include "flbc/harmonic.h"
#include "mesh/cell_geometry.h"
#include "support/test.h"

namespace flbc::testing {
namespace {

// Gradients of weights in the layout of the solver, padded by two numbers of rubbish.
template <class Scalar, int Dim>
struct Gradients {
  std::vector<Scalar> numbers;
  CellFieldView<Scalar, Dim> view;

  Gradients(const DomainMesh<Dim>& mesh, const WeightMatrix& weights) {
    const auto stride = static_cast<std::size_t>(weights.rows()) + 2;
    numbers.assign(mesh.num_cells() * Dim * stride, Scalar(1e30f));
    for (Index s = 0; s < mesh.num_cells(); ++s) {
      const auto geometry = cell_geometry(mesh, s);
      for (Index i = 0; i < weights.rows(); ++i) {
        Vector<Dim> gradient = Vector<Dim>::Zero();
        for (int k = 0; k <= Dim; ++k) {
          gradient += weights(i, mesh.cells(k, s)) * geometry.hat_gradients.col(k);
        }
        for (int d = 0; d < Dim; ++d) {
          numbers[(static_cast<std::size_t>(s) * Dim + d) * stride + i] =
              static_cast<Scalar>(gradient[d]);
        }
      }
    }
    view = {numbers.data(), stride, static_cast<Index>(weights.rows())};
  }
};

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
    const Gradients<double, Dim> exact(problem.mesh, weights);
    const Gradients<float, Dim> rounded(problem.mesh, weights);
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
  Gradients<float, Dim> gradients(problem.mesh, weights);
  for (std::size_t k = 0; k < gradients.numbers.size(); ++k) {
    gradients.numbers[k] *= 1 + 0.1f * std::sin(static_cast<float>(k));
  }
  const auto breadth_first = integrate_breadth_first(problem, gradients.view);
  for (const auto& recovered : {breadth_first, integrate_least_squares(problem, gradients.view)}) {
    const auto judgement = judge(problem.cage, problem.mesh, recovered);
    EXPECT_LT(judgement.partition_error, 1e-13);
    EXPECT_LT(judgement.reproduction_error, 1e-13);
    EXPECT_EQ(judgement.lagrange_error, 0);
    EXPECT_LT(judgement.linearity_error, 1e-11);
  }
  const ThreadScope one_thread(1);
  EXPECT_TRUE(
      (integrate_breadth_first(problem, gradients.view).array() == breadth_first.array()).all());
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

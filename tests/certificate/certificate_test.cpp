// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/certificate.h"

#include "flbc/harmonic.h"
#include "flbc/non_negative.h"
#include "polytope/vertex_linear_program.h"
#include "support/cell_field.h"
#include "support/feasible_vertices.h"

namespace flbc::testing {
namespace {

// phi A grad w / |grad w|: the flux that makes weights optimal if they are.
template <class Scalar, int Dim>
Field<Scalar, Dim> aligned_flux(const LbcProblem<Dim>& problem, const WeightMatrix& weights) {
  Field<Scalar, Dim> field(problem.mesh, problem.num_control_points());
  field.fill([&](Index s, Index i) {
    const Vector<Dim> gradient = gradient_of(problem.mesh, weights, s, i);
    const double length = std::max(gradient.norm(), 1e-300);
    return Vector<Dim>(problem.phi(i, s) * signed_measure(problem.mesh, s) / length * gradient);
  });
  return field;
}

// The known values on the boundary, and inside the row nearest to the given one.
template <int Dim>
WeightMatrix feasible(const LbcProblem<Dim>& problem, WeightMatrix weights) {
  const auto boundary = harmonic_coordinates(problem);
  for (Index v = 0; v < problem.mesh.num_vertices(); ++v) {
    if (problem.boundary.boundary_index[v] >= 0) weights.col(v) = boundary.col(v);
  }
  return project_non_negative(problem.cage.points, problem.mesh.points, weights,
                              problem.boundary.interior_vertices())
      .dense();
}

TEST_IN_2D_AND_3D(CertificateTest, LinearProgramFindsTheBestVertex) {
  Numbers numbers(5);
  for (int n = Dim + 1; n <= 9; ++n) {
    SCOPED_TRACE(n);
    for (int trial = 0; trial < 60; ++trial) {
      PointList<Dim> control_points = numbers.matrix(Dim, n, -1, 1);
      // Control points in few places and planes make many ties.
      if (trial % 3 == 0) control_points = (2 * control_points).array().round() / 2;
      Eigen::VectorXd weights = numbers.convex(n);
      if (trial % 4 == 1) weights = Eigen::VectorXd::Unit(n, numbers.below(n));
      const Vector<Dim> point = control_points * weights;
      const auto vertices = feasible_vertices<Dim>(control_points, point, 1e-12);
      if (vertices.empty()) continue;  // the control points lie in a plane
      Eigen::VectorXd costs = numbers.matrix(n, 1, -1, 1);
      if (trial % 5 == 0) costs = (2 * costs).array().round();
      double least = std::numeric_limits<double>::infinity();
      for (const auto& vertex : vertices) least = std::min(least, costs.dot(vertex));

      VertexLinearProgram<Dim> program(control_points);
      const Eigen::VectorXd useless = numbers.matrix(n, 1, -1, 1);
      for (const Eigen::VectorXd& start :
           {weights, vertices.back(), useless, Eigen::VectorXd::Zero(n).eval()}) {
        const double bound = program.lower_bound(point, costs, start);
        EXPECT_LE(bound, least + 1e-15);
        EXPECT_GE(bound, least - 1e-11);
      }
    }
  }
}

TEST_IN_2D_AND_3D(CertificateTest, LinearProgramIsOptimalForManyControlPoints) {
  Numbers numbers(6);
  const PointList<Dim> control_points = numbers.matrix(Dim, 250, -1, 1);
  VertexLinearProgram<Dim> program(control_points);
  for (int trial = 0; trial < 50; ++trial) {
    // Costs that are an affine function f, except for a few which are larger: the minimum is f(x).
    const Eigen::VectorXd slope = numbers.matrix(Dim, 1, -1, 1);
    Eigen::VectorXd costs = control_points.transpose() * slope;
    Eigen::VectorXd weights = Eigen::VectorXd::Zero(250);
    weights.head(240) = numbers.convex(240);
    costs.tail(10) += numbers.matrix(10, 1, 0, 1);
    const Vector<Dim> point = control_points * weights;
    const double bound = program.lower_bound(point, costs, numbers.convex(250));
    EXPECT_LE(bound, slope.dot(point) + 1e-15);
    EXPECT_GE(bound, slope.dot(point) - 1e-12);
  }
}

TEST_IN_2D_AND_3D(CertificateTest, BoundIsBelowAllFeasibleWeightsForAnyFlux) {
  Numbers numbers(8);
  for (const auto& sample : samples<Dim>()) {
    SCOPED_TRACE(sample.name);
    auto problem = make_problem(sample.cage, sample.mesh, DistanceScheme::kSquare, 0);
    const Index n = problem.num_control_points();
    const auto harmonic = feasible(problem, harmonic_coordinates(problem));
    std::vector<WeightMatrix> others{harmonic};
    for (int k = 0; k < 2; ++k) {
      others.push_back(
          feasible<Dim>(problem, numbers.matrix(n, problem.mesh.num_vertices(), -1, 1)));
    }
    double least = std::numeric_limits<double>::infinity();
    for (const auto& weights : others) {
      least = std::min(least, testing::objective(problem.mesh, weights, problem.phi.dense()));
    }
    const double nan = std::numeric_limits<double>::quiet_NaN();
    Field<double, Dim> field(problem.mesh, n);
    for (const double size : {0.0, 1e-3, 1.0, 1e3, 1e100, 1e300, nan}) {
      field.fill([&](Index, Index) { return numbers.matrix(Dim, 1, -size, size); });
      const double bound = lower_bound(problem, field.view, harmonic);
      EXPECT_GE(bound, 0);
      EXPECT_LE(bound, least * (1 + 1e-12));
    }
    const auto aligned = aligned_flux<double>(problem, harmonic);
    const double bound = lower_bound(problem, aligned.view, harmonic);
    EXPECT_LE(bound, least * (1 + 1e-12));
    // Boundary values alone cost something, and this flux is sensible.
    EXPECT_GT(bound, 0.02 * least);
    const auto in_single = aligned_flux<float>(problem, harmonic);
    EXPECT_NEAR(lower_bound(problem, in_single.view, harmonic), bound, 1e-4 * bound);
  }
}

// sum over v of w(v) D p(v) is what it is, also for a flux that is admissible and weights that
// attain every minimum: in a simplex there is only one feasible w, the linear one.
TEST_IN_2D_AND_3D(CertificateTest, BoundIsTheOptimumInASimplex) {
  Numbers numbers(9);
  const auto sample = make_sample<Dim>(Shape::kSimplex, 5, 0.2);
  auto problem = make_problem(sample.cage, sample.mesh, DistanceScheme::kSquare, 0);
  Eigen::MatrixXd phi = numbers.matrix(Dim + 1, problem.mesh.num_cells(), 0, 1);
  phi.col(0).setZero();
  phi.col(1).setConstant(1e-300);
  problem.phi = phi;
  ASSERT_FALSE(problem.boundary.interior_vertices().empty());
  const auto weights = harmonic_coordinates(problem);
  const double optimum = testing::objective(problem.mesh, weights, problem.phi.dense());
  auto field = aligned_flux<double>(problem, weights);
  double bound = lower_bound(problem, field.view, weights);
  EXPECT_LE(bound, optimum);
  EXPECT_GE(bound, optimum * (1 - 1e-11));

  // A flux that is too long is shortened, so that its length does not matter.
  for (double& number : field.numbers) number *= 3e5;
  bound = lower_bound(problem, field.view, weights);
  EXPECT_LE(bound, optimum);
  EXPECT_GE(bound, optimum * (1 - 1e-11));

  // A useless guess at the weights changes nothing; nor does the sign of a non-finite vector.
  const WeightMatrix useless = WeightMatrix::Constant(Dim + 1, weights.cols(), -1);
  EXPECT_GE(lower_bound(problem, field.view, useless), optimum * (1 - 1e-11));

  // Another flux: the dual function is the sum of p . grad w, which may be below 0 and counts as 0.
  double expected = 0;
  field.fill([&](Index s, Index i) {
    const double radius = problem.phi(i, s) * signed_measure(problem.mesh, s);
    const Vector<Dim> gradient = gradient_of(problem.mesh, weights, s, i);
    const Vector<Dim> p = (radius * numbers.uniform(0, 1) / gradient.norm()) * gradient;
    expected += p.dot(gradient);
    return p;
  });
  EXPECT_NEAR(lower_bound(problem, field.view, weights), expected, 1e-11 * expected);
  for (double& number : field.numbers) number = -number;
  EXPECT_EQ(lower_bound(problem, field.view, weights), 0);
}

TEST_IN_2D_AND_3D(CertificateTest, VectorsThatAreNotFiniteCountAsZero) {
  const auto sample = make_sample<Dim>(Shape::kBox, 4, 0.2);
  const auto problem = make_problem(sample.cage, sample.mesh, DistanceScheme::kSquare, 0);
  const auto weights = harmonic_coordinates(problem);
  auto broken = aligned_flux<float>(problem, weights);
  auto zeroed = aligned_flux<float>(problem, weights);
  for (Index s = 0; s < problem.mesh.num_cells(); s += 7) {
    broken.at(s, s % Dim, 1) = s % 2 == 0 ? std::numeric_limits<float>::quiet_NaN()
                                          : -std::numeric_limits<float>::infinity();
    for (int d = 0; d < Dim; ++d) zeroed.at(s, d, 1) = 0;
  }
  const double bound = lower_bound(problem, zeroed.view, weights);
  EXPECT_GT(bound, 0);
  EXPECT_EQ(lower_bound(problem, broken.view, weights), bound);
}

TEST_IN_2D_AND_3D(CertificateTest, ThreadsDoNotMatter) {
  const auto sample = make_sample<Dim>(Shape::kRing, Dim == 2 ? 12 : 5, 0.2);
  const auto problem = make_problem(sample.cage, sample.mesh, DistanceScheme::kSquare, 0);
  ASSERT_GT(problem.mesh.num_vertices(), 512);  // enough for several threads
  const auto weights = harmonic_coordinates(problem);
  const auto field = aligned_flux<double>(problem, weights);
  expect_same_for_any_threads([&] { return lower_bound(problem, field.view, weights); });
}

TEST_IN_2D_AND_3D(CertificateTest, CertifyMakesWeightsFeasible) {
  Numbers numbers(10);
  const auto sample = make_sample<Dim>(Shape::kCorner, 4, 0.2);
  const auto problem = make_problem(sample.cage, sample.mesh, DistanceScheme::kLinear, 0);
  const auto harmonic = harmonic_coordinates(problem);
  const auto field = aligned_flux<double>(problem, harmonic);
  const auto weights = feasible(problem, harmonic);
  const auto sound = certify(problem, field.view, weights);
  EXPECT_NEAR(sound.objective, testing::objective(problem.mesh, weights, problem.phi.dense()),
              1e-12 * sound.objective);
  EXPECT_NEAR(sound.relative_gap, 1 - sound.lower_bound / sound.objective, 1e-14);
  EXPECT_GT(sound.relative_gap, 0);
  EXPECT_LT(sound.relative_gap, 1);

  const WeightMatrix spoilt =
      harmonic + numbers.matrix(harmonic.rows(), harmonic.cols(), -0.5, 0.5);
  const auto repaired = certify(problem, field.view, spoilt);
  EXPECT_NEAR(repaired.objective,
              testing::objective(problem.mesh, feasible<Dim>(problem, spoilt), problem.phi.dense()),
              1e-12 * repaired.objective);
  EXPECT_GT(repaired.objective, sound.objective);
  // The linear programs end at the same minimum, wherever they start.
  EXPECT_NEAR(repaired.lower_bound, sound.lower_bound, 1e-10 * sound.objective);
}

TEST_IN_2D_AND_3D(CertificateTest, SizesThatDoNotFitAreErrors) {
  const auto sample = make_sample<Dim>(Shape::kBox, 3, 0.2);
  const auto problem = make_problem(sample.cage, sample.mesh, DistanceScheme::kConstant, 0);
  const auto weights = harmonic_coordinates(problem);
  const Index n = problem.num_control_points();
  Field<double, Dim> field(problem.mesh, n);
  expect_error<InputError>([&] { lower_bound(problem, field.view, weights.leftCols(2).eval()); },
                           {"2 points", std::to_string(n)});
  field.view.n = n - 1;
  expect_error<InputError>([&] { certify(problem, field.view, weights); },
                           {std::to_string(n - 1), std::to_string(n)});
}

}  // namespace
}  // namespace flbc::testing

// SPDX-License-Identifier: BSD-3-Clause
// Checks the reference optima by independent measures, by the setup of the library, and by
// optimality, without the program that made them.
#include "flbc/lbc_problem.h"
#include "support/harmonic_weights.h"
#include "support/reference_optimum.h"
#include "support/test.h"

namespace flbc::testing {
namespace {

// Twice the largest gap allowed to the program that made the references.
constexpr double kObjectiveTolerance = 2e-8;

template <int Dim>
const std::vector<ReferenceOptimum<Dim>>& references() {
  static const auto all = reference_optima<Dim>();
  return all;
}

template <int Dim>
Eigen::MatrixXd harmonic(const ReferenceOptimum<Dim>& reference) {
  return harmonic_weights(Sample<Dim>{reference.cage, reference.mesh, reference.name});
}

TEST_IN_2D_AND_3D(ReferencesTest, AreFeasible) {
  for (const auto& reference : references<Dim>()) {
    for (const auto* variant : {&reference.unconstrained, &reference.non_negative}) {
      SCOPED_TRACE(reference.name);
      const auto judgement = judge(reference.cage, reference.mesh, variant->weights);
      EXPECT_LT(judgement.partition_error, 1e-12);
      EXPECT_LT(judgement.reproduction_error, 1e-12);
      EXPECT_EQ(judgement.control_points_found, reference.cage.size());
      EXPECT_EQ(judgement.lagrange_error, 0);
      EXPECT_EQ(judgement.boundary_vertices_off_cage, 0);
      EXPECT_LT(judgement.linearity_error, 1e-12);
    }
    EXPECT_GE(reference.non_negative.weights.minCoeff(), -1e-9);
  }
}

TEST_IN_2D_AND_3D(ReferencesTest, HaveTheStatedObjectives) {
  for (const auto& reference : references<Dim>()) {
    SCOPED_TRACE(reference.name);
    for (const auto* variant : {&reference.unconstrained, &reference.non_negative}) {
      EXPECT_NEAR(testing::objective(reference.mesh, variant->weights, reference.phi),
                  variant->objective, 1e-8 * variant->objective);
      EXPECT_LT(std::abs(variant->gap), 1e-8);
    }
    EXPECT_GE(reference.non_negative.objective,
              reference.unconstrained.objective * (1 - kObjectiveTolerance));
  }
}

// Without such cases a solver that ignores the constraint would pass all comparisons.
TEST_IN_2D_AND_3D(ReferencesTest, HaveCasesInWhichTheConstraintMatters) {
  int cases = 0;
  for (const auto& reference : references<Dim>()) {
    if (reference.unconstrained.weights.minCoeff() > -1e-3) continue;
    ++cases;
    SCOPED_TRACE(reference.name);
    EXPECT_GT(
        (reference.unconstrained.weights - reference.non_negative.weights).cwiseAbs().maxCoeff(),
        1e-3);
    EXPECT_GT(reference.non_negative.objective, reference.unconstrained.objective);
  }
  EXPECT_GE(cases, Dim == 2 ? 1 : 2);
}

TEST_IN_2D_AND_3D(ReferencesTest, AreNoWorseThanMixturesWithOtherWeights) {
  for (const auto& reference : references<Dim>()) {
    SCOPED_TRACE(reference.name);
    const Eigen::MatrixXd other = harmonic(reference);
    const auto expect_no_less = [&](const auto& optimum, const Eigen::MatrixXd& weights) {
      EXPECT_GE(testing::objective(reference.mesh, weights, reference.phi),
                optimum.objective * (1 - kObjectiveTolerance));
    };
    for (const double part : {1e-4, 1e-2, 0.1, 0.5, 1.0}) {
      const auto& free = reference.unconstrained;
      const auto& bound = reference.non_negative;
      expect_no_less(free, (1 - part) * free.weights + part * other);
      expect_no_less(free, (1 - part) * free.weights + part * bound.weights);
      const Eigen::MatrixXd mixture = (1 - part) * bound.weights + part * other;
      if (mixture.minCoeff() >= 0) expect_no_less(bound, mixture);
    }
  }
}

// The matrix of the equations at a vertex, n x (Dim + 1).
template <int Dim>
Eigen::MatrixXd demands(const Cage<Dim>& cage) {
  Eigen::MatrixXd result(cage.size(), Dim + 1);
  result << Eigen::VectorXd::Ones(cage.size()), cage.points.transpose();
  return result;
}

// A step along which the weights at a vertex keep their equations.
template <int Dim>
Eigen::VectorXd random_step(const Cage<Dim>& cage, std::mt19937& random) {
  const Eigen::MatrixXd basis = null_space(demands(cage).transpose());
  const auto uniform = [&] { return double(random()) / 2147483648.0 - 1; };
  return basis * Eigen::VectorXd::NullaryExpr(basis.cols(), uniform).normalized();
}

// Non-negative weights that reproduce the point: its barycentric coordinates in a simplex of
// control points that contains it. \return nothing if none was found
template <int Dim>
Eigen::VectorXd random_weights(const Cage<Dim>& cage, const Vector<Dim>& point,
                               std::mt19937& random) {
  Eigen::VectorXd right(Dim + 1);
  right << 1, point;
  for (int attempt = 0; attempt < 100; ++attempt) {
    std::set<Index> corners;
    while (corners.size() < Dim + 1) corners.insert(Index(random() % unsigned(cage.size())));
    const std::vector<Index> chosen(corners.begin(), corners.end());
    const Eigen::MatrixXd equations = columns_of(demands(cage).transpose(), chosen);
    if (std::abs(determinant(equations)) < 1e-3) continue;
    const Eigen::VectorXd solution = solve_square(equations, right);
    if (solution.minCoeff() < 0) continue;
    Eigen::VectorXd weights = Eigen::VectorXd::Zero(cage.size());
    for (std::size_t k = 0; k < chosen.size(); ++k) weights[chosen[k]] = solution[Index(k)];
    return weights;
  }
  return {};
}

TEST_IN_2D_AND_3D(ReferencesTest, AreNoWorseThanTheirNeighbours) {
  for (const auto& reference : references<Dim>()) {
    SCOPED_TRACE(reference.name);
    const auto expect_no_less = [&](const auto& optimum, Index v, const Eigen::VectorXd& step) {
      Eigen::MatrixXd weights = optimum.weights;
      weights.col(v) += step;
      EXPECT_GE(testing::objective(reference.mesh, weights, reference.phi),
                optimum.objective * (1 - kObjectiveTolerance));
    };
    std::mt19937 random(1);
    int tried = 0, found = 0;
    const auto interior = interior_vertices(reference.mesh);
    for (Index v = 0; v < reference.mesh.num_vertices(); ++v) {
      if (!interior[v]) continue;
      const Eigen::VectorXd step = 1e-3 * random_step(reference.cage, random);
      expect_no_less(reference.unconstrained, v, step);
      expect_no_less(reference.unconstrained, v, -step);
      const Vector<Dim> point = reference.mesh.points.col(v);
      const Eigen::VectorXd other = random_weights(reference.cage, point, random);
      ++tried;
      if (other.size() == 0) continue;
      ++found;
      expect_no_less(reference.non_negative, v,
                     1e-2 * (other - reference.non_negative.weights.col(v)));
    }
    EXPECT_GE(found, tried / 2);
  }
}

TEST_IN_2D_AND_3D(ReferencesTest, AreAcceptedAsProblems) {
  std::set<std::string> names;
  for (const auto& reference : references<Dim>()) {
    SCOPED_TRACE(reference.name);
    names.insert(reference.name);
    EXPECT_TRUE(find_defects(reference.cage).empty());
    EXPECT_GE(reference.phi.minCoeff(), 0);
    EXPECT_LE(reference.phi.maxCoeff(), 1);
    const auto problem = make_problem(reference.cage, reference.mesh, DistanceScheme::kConstant);
    ASSERT_EQ(problem.mesh.cells, reference.mesh.cells);
    const auto& optimum = reference.non_negative;
    const double scaled = optimum.objective * std::pow(problem.scale, Dim - 1);
    EXPECT_NEAR(testing::objective(problem.mesh, optimum.weights, reference.phi), scaled,
                1e-8 * scaled);
  }
  EXPECT_EQ(names.size(), references<Dim>().size());
  EXPECT_GE(names.size(), 4u);
}

}  // namespace
}  // namespace flbc::testing

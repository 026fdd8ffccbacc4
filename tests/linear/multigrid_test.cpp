// SPDX-License-Identifier: BSD-3-Clause
#include <Eigen/Dense>

#include "linear/multigrid.h"
#include "linear/multigrid_cg.h"
#include "mesh/cell_geometry.h"
#include "problem/laplacian.h"
#include "solver/methods/splitting/compact_splitting.h"
#include "support/splitting_cases.h"

namespace flbc::testing {
namespace {

constexpr std::size_t kStride = 24;

// The stiffness matrix on the interior vertices: what the splitting solves.
template <int Dim>
RowMatrix interior_matrix(Shape shape, Index subdivisions, double perturbation) {
  const auto sample = make_sample<Dim>(shape, subdivisions, perturbation);
  const auto on_boundary =
      boundary_vertices(build_topology(sample.mesh), sample.mesh.num_vertices());
  std::vector<Index> interior;
  for (Index v = 0; v < sample.mesh.num_vertices(); ++v) {
    if (!on_boundary[v]) interior.push_back(v);
  }
  return stiffness_matrix(sample.mesh, cell_measures(sample.mesh), interior);
}

template <class Scalar>
using Rows = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

Rows<double> random_panel(Eigen::Index size, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-1, 1);
  return Rows<double>::NullaryExpr(size, kStride, [&] { return uniform(random); });
}

template <class Scalar>
Rows<double> cycle(Multigrid<Scalar>& multigrid, const Rows<double>& right_side) {
  AlignedArray<Scalar> rows(static_cast<std::size_t>(right_side.size()));
  Eigen::Map<Rows<Scalar>> map(rows.data(), right_side.rows(), kStride);
  map = right_side.cast<Scalar>();
  multigrid.cycle_slice(rows.data(), 0, kStride);
  return map.template cast<double>();
}

// The slowest of the errors e <- (I - B^-1 A) e after some steps, measured as |e|_A.
double contraction(const RowMatrix& matrix, Multigrid<double>& multigrid) {
  Rows<double> error = random_panel(matrix.rows(), 7);
  double factor = 1;
  for (int step = 0; step < 15; ++step) {
    const double before = std::sqrt(error.cwiseProduct(matrix * error).sum());
    error -= cycle(multigrid, matrix * error);
    factor = std::sqrt(error.cwiseProduct(matrix * error).sum()) / before;
    error /= before;
  }
  return factor;
}

TEST_IN_2D_AND_3D(MultigridTest, ContractsAlikeOnCoarseAndFineMeshes) {
  for (const double perturbation : {0.0, 0.25}) {
    for (const Index subdivisions : {Dim == 2 ? 60 : 16, Dim == 2 ? 200 : 36}) {
      const auto matrix = interior_matrix<Dim>(Shape::kBox, subdivisions, perturbation);
      Multigrid<double> multigrid(matrix, kStride);
      EXPECT_LT(contraction(matrix, multigrid), 0.75) << subdivisions << ' ' << perturbation;
      EXPECT_LT(multigrid.operator_complexity(), 1.6);
    }
  }
}

TEST_IN_2D_AND_3D(MultigridTest, IsLinearAndSymmetric) {
  const auto matrix = interior_matrix<Dim>(Shape::kCorner, Dim == 2 ? 50 : 12, 0.2);
  Multigrid<double> multigrid(matrix, kStride);
  const auto x = random_panel(matrix.rows(), 1);
  const auto y = random_panel(matrix.rows(), 2);
  const auto bx = cycle(multigrid, x);
  const auto by = cycle(multigrid, y);
  const Rows<double> combined = cycle<double>(multigrid, 2 * x - 3 * y);
  EXPECT_LT((combined - (2 * bx - 3 * by)).norm(), 1e-12 * combined.norm());
  const Eigen::RowVectorXd xby = x.cwiseProduct(by).colwise().sum();
  const Eigen::RowVectorXd bxy = bx.cwiseProduct(y).colwise().sum();
  EXPECT_LT((xby - bxy).norm(), 1e-11 * bx.norm() * y.norm());
  // B >= A: a cycle never goes too far, which keeps a splitting method convergent.
  const Eigen::RowVectorXd energy = bx.cwiseProduct(matrix * bx).colwise().sum();
  const Eigen::RowVectorXd work = bx.cwiseProduct(x).colwise().sum();
  EXPECT_TRUE((energy.array() <= work.array() * (1 + 1e-12)).all());
  EXPECT_TRUE((energy.array() > 0).all());
}

TEST_IN_2D_AND_3D(MultigridTest, SinglePrecisionIsTheSameCycle) {
  const auto matrix = interior_matrix<Dim>(Shape::kRing, Dim == 2 ? 24 : 6, 0);
  Multigrid<double> exact(matrix, kStride);
  Multigrid<float> multigrid(matrix, kStride);
  const auto x = random_panel(matrix.rows(), 3);
  EXPECT_LT((cycle(multigrid, x) - cycle(exact, x)).norm(), 1e-5 * cycle(exact, x).norm());
}

TEST_IN_2D_AND_3D(MultigridTest, EverySliceGivesTheSameBits) {
  const auto matrix = interior_matrix<Dim>(Shape::kBox, Dim == 2 ? 50 : 14, 0.2);
  Multigrid<float> multigrid(matrix, kStride);
  const Rows<float> right_side = random_panel(matrix.rows(), 4).template cast<float>();
  const auto run = [&](std::initializer_list<std::size_t> borders) {
    AlignedArray<float> rows(static_cast<std::size_t>(right_side.size()));
    std::copy_n(right_side.data(), right_side.size(), rows.data());
    for (auto end = borders.begin() + 1; end != borders.end(); ++end) {
      multigrid.cycle_slice(rows.data(), end[-1], *end);
    }
    return rows;
  };
  const auto whole = run({0, kStride});
  for (const auto& pieces : {run({0, 8, kStride}), run({0, 16, kStride}), run({0, 8, 16, 24})}) {
    EXPECT_EQ(std::memcmp(whole.data(), pieces.data(), whole.size() * sizeof(float)), 0);
  }
}

// As accurate as documented, for right-hand sides of any size, and bit-identical for any number of
// threads.
TEST_IN_2D_AND_3D(MultigridTest, PreconditionsConjugateGradients) {
  const auto matrix = interior_matrix<Dim>(Shape::kCorner, Dim == 2 ? 50 : 12, 0.2);
  const MultigridCg solver(matrix);
  Rows<double> exact = random_panel(matrix.rows(), 6);
  exact.col(1) *= 1e-20;
  exact.col(2).setZero();
  const Rows<double> right_side = matrix * exact;
  const auto run = [&](int count) {
    const ThreadScope threads(count);
    AlignedArray<double> rows(static_cast<std::size_t>(right_side.size()));
    std::copy_n(right_side.data(), right_side.size(), rows.data());
    solver.solve(rows.data(), kStride);
    return Rows<double>(Eigen::Map<Rows<double>>(rows.data(), matrix.rows(), kStride));
  };
  const auto solution = run(1);
  const Rows<double> error = solution - exact;
  const Eigen::ArrayXd size = exact.cwiseProduct(matrix * exact).colwise().sum();
  const Eigen::ArrayXd left = error.cwiseProduct(matrix * error).colwise().sum();
  EXPECT_TRUE((left <= 1e-12 * size).all()) << (left / size).maxCoeff();
  EXPECT_EQ((run(2) - solution).cwiseAbs().maxCoeff(), 0);
}

// The optimum does not depend on how the linear systems are solved.
TEST_IN_2D_AND_3D(MultigridTest, LeavesTheOptimumWhereItIs) {
  for (const auto& sample : samples<Dim>()) {
    SCOPED_TRACE(sample.name);
    constexpr double kSmoothness = 0.01;  // the optimum is unique
    const auto problem =
        make_problem(sample.cage, sample.mesh, DistanceScheme::kSquare, kSmoothness);
    const auto metric = make_metric(problem, 1, true);
    const auto after = [&](int iterations, LinearSolver solver) {
      compact::Parameters parameters;
      parameters.penalty = make_penalty(problem, metric);
      parameters.linear_solver = solver;
      compact::CompactSplitting<double, Dim> splitting(problem, metric, parameters);
      splitting.start({});
      for (int k = 0; k < iterations; ++k) {
        splitting.iterate(k, 1);
        splitting.adapt({k + 1, 1, 1, false});
      }
      return splitting.all_weights();
    };
    const auto optimum = after(3000, LinearSolver::kDirect);
    const auto squared_error = [&](int iterations, LinearSolver solver) {
      return (after(iterations, solver) - optimum).squaredNorm() /
             static_cast<double>(optimum.size());
    };
    EXPECT_LT(squared_error(3000, LinearSolver::kMultigrid), 1e-12);
    EXPECT_LT(squared_error(320, LinearSolver::kMultigrid),
              1e-12 + squared_error(100, LinearSolver::kDirect));
  }
}

TEST(MultigridOfDiagonalsTest, TakesMatricesThatCannotBeCoarsened) {
  for (const Index size : {1, 3, 5000}) {
    RowMatrix diagonal(size, size);
    for (Index k = 0; k < size; ++k) diagonal.insert(k, k) = k + 1;
    Multigrid<double> multigrid(diagonal, kStride);
    const auto x = random_panel(size, 5);
    const Rows<double> solved = cycle(multigrid, x);
    EXPECT_LT((diagonal * solved - x).norm(), 1e-12 * x.norm()) << size;
  }
}

}  // namespace
}  // namespace flbc::testing

// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/harmonic.h"

#include "flbc/coordinates.h"
#include "support/cages_of_all_kinds.h"

namespace flbc::testing {
namespace {

// L M^-1 L from the inverses of the corner matrices.
template <int Dim>
Eigen::MatrixXd dense_energy(const DomainMesh<Dim>& mesh) {
  const Eigen::Index size = mesh.num_vertices();
  Eigen::MatrixXd laplacian = Eigen::MatrixXd::Zero(size, size);
  Eigen::VectorXd mass = Eigen::VectorXd::Zero(size);
  for (Index s = 0; s < mesh.num_cells(); ++s) {
    Eigen::Matrix<double, Dim + 1, Dim + 1> corners;
    corners << Eigen::Matrix<double, 1, Dim + 1>::Ones(),
        mesh.points(Eigen::all, mesh.cells.col(s));
    const double measure = std::abs(corners.determinant()) / (Dim == 2 ? 2 : 6);
    const Eigen::Matrix<double, Dim + 1, Dim> gradients = corners.inverse().rightCols(Dim);
    laplacian(mesh.cells.col(s), mesh.cells.col(s)) += measure * gradients * gradients.transpose();
    mass(mesh.cells.col(s)).array() += measure / (Dim + 1);
  }
  return laplacian * mass.cwiseInverse().asDiagonal() * laplacian;
}

// Minimizes x^T A x / 2 - b^T x with 0 <= x <= 1 by a primal active set method.
Eigen::VectorXd minimize_in_box(const Eigen::MatrixXd& a, const Eigen::VectorXd& b) {
  Eigen::VectorXd x = Eigen::VectorXd::Constant(b.size(), 0.5);
  std::vector<int> side(static_cast<std::size_t>(b.size()), 0);  // -1 or 1 at a bound
  for (int step = 0; step < 10000; ++step) {
    std::vector<Eigen::Index> open;
    for (Eigen::Index i = 0; i < b.size(); ++i) {
      if (side[i] == 0) open.push_back(i);
    }
    const Eigen::VectorXd slope = b - a * x;
    const Eigen::VectorXd move = solve_symmetric(a(open, open), slope(open));
    double length = 1;
    Eigen::Index blocked = -1;
    for (std::size_t k = 0; k < open.size(); ++k) {
      const double room = move[k] > 0 ? 1 - x[open[k]] : x[open[k]];
      if (std::abs(move[k]) * length > room) {
        length = room / std::abs(move[k]);
        blocked = static_cast<Eigen::Index>(k);
      }
    }
    x(open) += length * move;
    if (blocked >= 0) {
      side[open[blocked]] = move[blocked] > 0 ? 1 : -1;
      x[open[blocked]] = move[blocked] > 0 ? 1 : 0;
      continue;
    }
    const Eigen::VectorXd force = b - a * x;  // must press against the bounds
    Eigen::Index worst = -1;
    double most = 1e-9 * b.cwiseAbs().maxCoeff();
    for (Eigen::Index i = 0; i < b.size(); ++i) {
      if (-side[i] * force[i] > most) {
        most = -side[i] * force[i];
        worst = i;
      }
    }
    if (worst < 0) return x;
    side[worst] = 0;
  }
  ADD_FAILURE() << "the judge does not converge";
  return x;
}

TEST_IN_2D_AND_3D(BiharmonicTest, MinimizesTheEnergyWithinBounds) {
  for (const auto shape : {Shape::kCorner, Shape::kStar}) {
    const auto sample = make_sample<Dim>(shape, Dim == 2 ? 5 : 4, 0.2);
    const auto problem = make_problem(sample.cage, sample.mesh, DistanceScheme::kSquare, 0);
    const auto weights = bounded_biharmonic_weights(problem);
    const auto energy = dense_energy(problem.mesh);
    const auto inside = problem.boundary.interior_vertices();
    WeightMatrix expected =
        WeightMatrix::Zero(problem.num_control_points(), problem.mesh.num_vertices());
    problem.boundary.impose_on(expected);
    int bounded = 0;
    for (Index i = 0; i < problem.num_control_points(); ++i) {
      const Eigen::VectorXd given = expected.row(i);
      const Eigen::VectorXd best =
          minimize_in_box(energy(inside, inside), -(energy * given)(inside));
      bounded += static_cast<int>((best.array() == 0).count());
      expected(i, inside) = best.transpose();
    }
    EXPECT_GT(bounded, 0);  // otherwise bounds would not matter
    const Eigen::RowVectorXd sums = expected.colwise().sum();
    expected.array().rowwise() /= sums.array();
    EXPECT_LT((weights - expected).cwiseAbs().maxCoeff(), 2e-4) << sample.name;
  }
}

TEST_IN_2D_AND_3D(BiharmonicTest, WithinBoundsWithSumOneAndLinearOnFacets) {
  for (const auto& sample : cages<Dim>()) {
    SCOPED_TRACE(sample.name);
    const auto problem = make_problem(sample.cage, sample.mesh, DistanceScheme::kSquare, 0);
    auto weights = bounded_biharmonic_weights(problem);
    EXPECT_GE(weights.minCoeff(), 0);
    EXPECT_LE(weights.maxCoeff(), 1);
    EXPECT_LT((weights.colwise().sum().array() - 1).abs().maxCoeff(), 1e-14);
    auto imposed = weights;
    problem.boundary.impose_on(imposed);
    EXPECT_LT((weights - imposed).cwiseAbs().maxCoeff(), 1e-14);
  }
}

TEST(BiharmonicTest, DoNotDependOnThreadsAndRefuseProjection) {
  const auto sample = make_sample<2>(Shape::kStar, 4);
  const auto weights = [&](const CoordinatesOptions& options) {
    return compute_coordinates(sample.cage, sample.mesh, Coordinates::kBiharmonic, options).weights;
  };
  EXPECT_EQ(weights({NonNegative::kAuto, 3}), weights({NonNegative::kAuto, 1}));
  EXPECT_THROW(weights({NonNegative::kProject}), OptionError);
}

}  // namespace
}  // namespace flbc::testing
